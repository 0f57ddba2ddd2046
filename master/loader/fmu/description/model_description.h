// Reads modelDescription.xml of FMI 1.0, 2.0 and 3.0.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_MODEL_DESCRIPTION_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_MODEL_DESCRIPTION_H

#include <filesystem>
#include <optional>
#include <string>

#include "master/engine/model/description.h"
#include "master/loader/fmu/description/fmi1_attributes.h"
#include "master/loader/fmu/description/fmi2_attributes.h"

namespace stride::importer {

/// A unit's description, and what only its instances need to know.
struct ModelDescription : core::UnitDescription {
  std::optional<Fmi1Attributes> fmi1;  ///< of an FMI 1.0 unit
  std::optional<Fmi2Attributes> fmi2;  ///< of an FMI 2.0 unit
};

/// The description of a Co-Simulation unit. Dimensions that a structural parameter gives are
/// resolved with its start value; what a variable leaves to its declared type is filled in.
///
/// Throws core::Error of the kind Input, with file and line, for what is no well-formed description
/// of FMI 1.0, 2.0 or 3.0, for other versions, for a unit without Co-Simulation, and for references
/// that lead nowhere. `shown_as` is the file's name in such messages.
ModelDescription read_model_description(const std::filesystem::path& file,
                                        const std::string& shown_as = "");

/// The same from the document's text.
ModelDescription parse_model_description(const std::string& text, const std::string& shown_as);

}  // namespace stride::importer

#endif
