#ifndef STRIDE_UNIT_UNIT_OF_MEASURE_DEFINITION_H
#define STRIDE_UNIT_UNIT_OF_MEASURE_DEFINITION_H

#include <string>

namespace stride {

/// A unit of measure that a unit defines: a value of it is factor * value + offset in the unit
/// `in`, which the kit knows.
struct UnitOfMeasureDefinition {
  std::string name;
  double factor = 1;
  std::string in;
  double offset = 0;
};

}  // namespace stride

#endif
