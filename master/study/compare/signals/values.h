#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_VALUES_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_VALUES_H

#include <cstddef>
#include <type_traits>
#include <variant>

#include "master/report/column.h"

namespace stride::compare {

/// Of a column that holds no texts; of Booleans 0 and 1.
inline double number(const report::Column& column, std::size_t row) {
  return std::visit(
      [&](const auto& values) -> double {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(values)>, report::Texts>) {
          return 0;
        } else {
          return static_cast<double>(values[row]);
        }
      },
      column.values());
}

/// Whether the values are compared as numbers, rather than as texts: Booleans with Booleans only.
inline bool are_numbers(const report::Column& a, const report::Column& b) {
  const auto is_text = [](const report::Column& column) {
    return std::holds_alternative<report::Texts>(column.values());
  };
  const auto is_boolean = [](const report::Column& column) {
    return column.type() == core::ValueType::Boolean;
  };
  return !is_text(a) && !is_text(b) && is_boolean(a) == is_boolean(b);
}

}  // namespace stride::compare

#endif
