// The value of an option, of its text.
#ifndef STRIDE_MASTER_BASE_PARSE_OPTION_H
#define STRIDE_MASTER_BASE_PARSE_OPTION_H

#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "master/base/error.h"

namespace stride::core {

/// What parse(text) returns. Where that throws std::invalid_argument, throws core::Error (Input)
/// with the option, the text and what was expected.
template <class Parse>
auto parse_option(const std::string& option, const std::string& text, Parse&& parse) {
  try {
    return parse(text);
  } catch (const std::invalid_argument& mistake) {
    fail_input({}, fmt::format("{} {}: {}", option, text, mistake.what()));
  }
}

}  // namespace stride::core

#endif
