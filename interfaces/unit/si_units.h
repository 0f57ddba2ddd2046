#ifndef STRIDE_INTERFACES_UNIT_SI_UNITS_H
#define STRIDE_INTERFACES_UNIT_SI_UNITS_H

#include <optional>
#include <string_view>

namespace stride::kit {

/// A unit of measure in SI base units, with the parts of FMI's element BaseUnit:
/// value in base units = factor * value + offset.
struct BaseUnitOfMeasure {
  int kg, m, s, A, K, mol, cd, rad;
  double factor, offset;
};

/// What a unit symbol in the Modelica notation means, for the symbols that occur in models of this
/// kind. Of any other symbol the model description has the name alone, and importers compare names.
std::optional<BaseUnitOfMeasure> base_unit_of_measure(std::string_view symbol);

}  // namespace stride::kit

#endif
