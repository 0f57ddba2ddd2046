// Packs a library made with the unit kit into a .fmu archive, or a .fmu again with other resources.
#ifndef STRIDE_MASTER_LOADER_FMU_PACK_H
#define STRIDE_MASTER_LOADER_FMU_PACK_H

#include <filesystem>
#include <string>
#include <vector>

namespace stride::importer {

struct PackRequest {
  std::filesystem::path library;               ///< or a .fmu that has one
  std::filesystem::path resources;             ///< a folder, or empty
  std::vector<std::filesystem::path> bundled;  ///< shared libraries that go beside the unit's own
  std::filesystem::path output;
  std::string model_name{};  ///< instead of the one that the library gives; empty: that one
};

/// Gives the description that a library of the unit kit has of itself another model name.
void set_model_name(std::string& description, const std::string& name);

/// Asks the library for its model description with these resources and writes the archive:
/// modelDescription.xml, binaries/<platform>/<modelIdentifier>.so and the bundled libraries,
/// resources/, and extra/org.stride.idle/ if the unit can promise to be idle. From a .fmu it takes
/// all of binaries/; its own resources stay behind, so there must be others. The same input gives
/// the same bytes, and the output is replaced only when it is complete. Returns warnings. Throws
/// core::Error: Input for what is given wrongly, Run if it cannot be written.
std::vector<std::string> pack(const PackRequest& request);

}  // namespace stride::importer

#endif
