// Reads the manifest of org.stride.idle, by which a unit declares that it can promise to be idle
// (<stride/idle.h>, docs/idle.md).
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_IDLE_MANIFEST_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_IDLE_MANIFEST_H

#include <filesystem>
#include <string>

#include "master/engine/model/description.h"

namespace stride::importer {

/// Fills in promises_idle, and the deadbands and tolerances of the variables. Throws core::Error of
/// the kind Input, with file and line, for what is no manifest of org.stride.idle 1.x, and for
/// entries that do not fit the unit's variables. `shown_as` is the file's name in such messages.
void read_idle_manifest(const std::filesystem::path& file, const std::string& shown_as,
                        core::UnitDescription& unit);

/// The same from the document's text.
void parse_idle_manifest(const std::string& text, const std::string& shown_as,
                         core::UnitDescription& unit);

}  // namespace stride::importer

#endif
