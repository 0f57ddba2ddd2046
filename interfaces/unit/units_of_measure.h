#ifndef STRIDE_INTERFACES_UNIT_UNITS_OF_MEASURE_H
#define STRIDE_INTERFACES_UNIT_UNITS_OF_MEASURE_H

#include <optional>
#include <string>

#include <stride/unit.h>
#include <stride/unit_of_measure.h>

namespace stride::kit {

/// Throws std::logic_error for a definition that means nothing, or is there twice.
void check_units_of_measure(const Unit& unit);

/// What a symbol of the unit's variables means: by the unit's own definition, or else by the table
/// of known ones. Of any other symbol the model description has the name alone.
std::optional<BaseUnitOfMeasure> base_unit_of_measure(const Unit& unit, const std::string& symbol);

}  // namespace stride::kit

#endif
