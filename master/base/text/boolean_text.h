#ifndef STRIDE_MASTER_BASE_TEXT_BOOLEAN_TEXT_H
#define STRIDE_MASTER_BASE_TEXT_BOOLEAN_TEXT_H

#include <optional>
#include <string_view>

namespace stride::core {

/// A Boolean as XML Schema writes it: "true", "1", "false", "0". Nothing for any other text.
inline std::optional<bool> boolean_of(std::string_view text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  return std::nullopt;
}

}  // namespace stride::core

#endif
