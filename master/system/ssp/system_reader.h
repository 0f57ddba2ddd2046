// The <ssd:System> of a scenario, with all that it names in other files of SSP.
#ifndef STRIDE_MASTER_SYSTEM_SSP_SYSTEM_READER_H
#define STRIDE_MASTER_SYSTEM_SSP_SYSTEM_READER_H

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/system/ssp/files.h"
#include "master/system/ssp/system_tree.h"

namespace stride::ssp {

/// Checks the root element of a .ssd. Throws core::Error (Input), also for a file of another kind,
/// which it calls by its name.
void check_system_description(const xml::Element& root);

/// The <ssd:System> elements below a root element, by their ids, which source="#id" names.
std::map<std::string, xml::Element> systems_by_id(const xml::Element& root);

/// Reads the system below a root element that was checked, and the .ssd and .ssp files that are
/// components of it. `path` is its file; what is odd, but no mistake, is listed in
/// `warnings`. Throws core::Error (Input).
SystemNode read_system(const xml::Element& root, const std::filesystem::path& path, Files& files,
                       std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
