// Signal dictionaries of SSP (.ssb): names for signals that systems share.
#ifndef STRIDE_MASTER_SSP_SIGNAL_DICTIONARY_H
#define STRIDE_MASTER_SSP_SIGNAL_DICTIONARY_H

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "master/ssp/connectors.h"
#include "master/ssp/files.h"
#include "master/ssp/system_tree.h"
#include "master/util/xml/element.h"

namespace stride::ssp {

/// Reads <ssd:SignalDictionaries>, inline or from files relative to one of `folders`. Throws
/// core::Error (Input).
std::map<std::string, SignalDictionary> read_signal_dictionaries(
    const xml::Element& dictionaries, std::span<const std::filesystem::path> folders, Files& files,
    std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
