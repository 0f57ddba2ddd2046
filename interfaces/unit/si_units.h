#ifndef STRIDE_INTERFACES_UNIT_SI_UNITS_H
#define STRIDE_INTERFACES_UNIT_SI_UNITS_H

#include <optional>
#include <string_view>

namespace stride::kit {

/// value in SI base units = factor * value + offset; the exponents in the order of FMI's BaseUnit.
struct BaseUnit {
  int kg, m, s, A, K, mol, cd, rad;
  double factor, offset;
};

/// What a unit symbol in the Modelica notation means, for the symbols that occur in models of this
/// kind. For any other symbol the importer is told the name alone, and compares names.
std::optional<BaseUnit> base_unit(std::string_view symbol);

}  // namespace stride::kit

#endif
