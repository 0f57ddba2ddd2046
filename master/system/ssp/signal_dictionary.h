// Signal dictionaries of SSP (.ssb): names for signals that systems share.
#ifndef STRIDE_MASTER_SYSTEM_SSP_SIGNAL_DICTIONARY_H
#define STRIDE_MASTER_SYSTEM_SSP_SIGNAL_DICTIONARY_H

#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/system/ssp/connectors.h"
#include "master/system/ssp/files.h"
#include "master/system/ssp/system_tree.h"

namespace stride::ssp {

/// Where signal dictionaries are referred to.
struct DictionaryContext {
  Files& files;
  std::span<const std::filesystem::path> folders;  ///< one of which the sources are relative to
  const Definitions& definitions;  ///< for units that a dictionary does not define, with a warning
  std::vector<std::string>& warnings;
};

/// Reads <ssd:SignalDictionaries>, inline or from files. Throws core::Error (Input).
std::map<std::string, SignalDictionary> read_signal_dictionaries(const xml::Element& dictionaries,
                                                                 const DictionaryContext& context);

}  // namespace stride::ssp

#endif
