#ifndef STRIDE_INTERFACES_UNIT_UNITS_OF_MEASURE_H
#define STRIDE_INTERFACES_UNIT_UNITS_OF_MEASURE_H

#include <stride/unit.h>
#include <stride/unit_of_measure.h>

namespace stride::kit {

/// Throws std::logic_error for a definition that means nothing, or is there twice.
void check_units_of_measure(const Unit& unit);

/// The unit's own definitions, which go before the table of known symbols. Of what
/// find_unit_of_measure() does not find with them the model description has the name alone.
OwnUnitsOfMeasure own_units_of_measure(const Unit& unit);

}  // namespace stride::kit

#endif
