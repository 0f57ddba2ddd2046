// The file that defines the quantity that is compared.
#ifndef STRIDE_UNITS_GROUND_TRUTH_QUANTITY_H
#define STRIDE_UNITS_GROUND_TRUTH_QUANTITY_H

#include <string>

namespace ground_truth {

/// The units of a quantity, in the Modelica notation; empty for a number.
struct Quantity {
  std::string unit;        ///< of a value
  std::string difference;  ///< of the difference of two values: K for degC
};

/// Reads a file such as
///
///     <quantity version="1" unit="degC" difference="K"/>
///
/// Throws std::runtime_error with file, line and what was expected.
Quantity read_quantity(const std::string& file);

/// The same from a text, for whose errors `file` is the name.
Quantity parse_quantity(const std::string& text, const std::string& file);

}  // namespace ground_truth

#endif
