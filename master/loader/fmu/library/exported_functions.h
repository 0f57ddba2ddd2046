// What the library of a unit must export, before it is loaded.
#ifndef STRIDE_MASTER_LOADER_FMU_LIBRARY_EXPORTED_FUNCTIONS_H
#define STRIDE_MASTER_LOADER_FMU_LIBRARY_EXPORTED_FUNCTIONS_H

#include <filesystem>
#include <string>

#include "master/engine/model/description.h"

namespace stride::importer {

/// That the functions of a library have the prefix of a static one, and what to do about it.
std::string prefix_note(const std::string& prefix);

/// For a library of FMI 2.0 or 3.0 that was built. Throws core::Error (Input) where it does not
/// export a function that any Co-Simulation unit must have; the error contains those that end in
/// its name. Returns prefix_note() where they have the prefix `<modelIdentifier>_`, else an empty
/// text.
std::string check_exported_functions(const std::filesystem::path& library,
                                     const core::UnitDescription& unit);

}  // namespace stride::importer

#endif
