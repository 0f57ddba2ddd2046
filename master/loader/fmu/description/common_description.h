// What the descriptions of all versions of FMI have in common.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_COMMON_DESCRIPTION_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_COMMON_DESCRIPTION_H

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/xml/element.h"
#include "master/engine/model/description.h"

namespace stride::importer {

// Each throws core::Error of the kind Input with the position of what is wrong.

/// <CoSimulation>, which the unit must have.
xml::Element find_co_simulation(const xml::Element& root, std::vector<std::string>& warnings);
/// The name of the library, a plain one, which cannot lead to another folder.
std::string read_model_identifier(const xml::Element& owner);
/// The attributes of <CoSimulation> that have one name in FMI 2.0 and 3.0.
void read_capabilities(const xml::Element& co_simulation, core::UnitDescription& unit);
/// Nothing if there is no such attribute; it must be positive.
std::optional<core::Interval> read_step_size(const xml::Element& element, const char* attribute);
/// <UnitDefinitions>, and <DefaultExperiment>, of which attributes that cannot be used are ignored,
/// with a warning for each.
void read_units(const xml::Element& root, core::UnitDescription& unit);
void read_default_experiment(const xml::Element& root, core::UnitDescription& unit);
/// The lists of <ModelStructure> that these functions read. One that is missing, or that refers to
/// what is not there, is ignored with a warning: each output may depend on all inputs then.
using UnknownsReader = std::function<std::vector<core::Unknown>(const xml::Element& structure)>;
void read_model_structure(const xml::Element& root, core::UnitDescription& unit,
                          const UnknownsReader& read_outputs, const UnknownsReader& read_initial);

}  // namespace stride::importer

#endif
