// Reads modelDescription.xml of FMI 3.0 (2.4 there).
#ifndef STRIDE_MASTER_FMI_MODEL_DESCRIPTION_H
#define STRIDE_MASTER_FMI_MODEL_DESCRIPTION_H

#include <filesystem>
#include <string>

#include "master/core/description.h"

namespace stride::fmi {

/// The description of a Co-Simulation unit. Dimensions that a structural parameter gives are
/// resolved with its start value; what a variable leaves to its declared type is filled in.
///
/// Throws core::Error of the kind Input, with file and line, for what is no well-formed FMI 3
/// description, for other versions of FMI, for a unit without Co-Simulation, and for references
/// that lead nowhere. `shown_as` is the file's name in such messages.
core::UnitDescription read_model_description(const std::filesystem::path& file,
                                             const std::string& shown_as = "");

/// The same from the document's text.
core::UnitDescription parse_model_description(const std::string& text, const std::string& shown_as);

}  // namespace stride::fmi

#endif
