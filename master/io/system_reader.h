// The <ssd:System> of a scenario.
#ifndef STRIDE_MASTER_IO_SYSTEM_READER_H
#define STRIDE_MASTER_IO_SYSTEM_READER_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/core/system.h"
#include "master/xml/element.h"

namespace stride::io {

struct SystemContent {
  core::SystemDeclaration declaration;
  std::vector<std::filesystem::path> sources;  ///< of the components, in their order
};

/// Components, connections and parameters. `folder` is where the .ssd stands. Throws core::Error
/// (Input).
SystemContent read_system(const xml::Element& system, const std::string& ssp_version,
                          const std::filesystem::path& folder);

}  // namespace stride::io

#endif
