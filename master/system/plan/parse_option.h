// Values of options of the command line.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_PARSE_OPTION_H
#define STRIDE_MASTER_SYSTEM_PLAN_PARSE_OPTION_H

#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "master/base/error.h"

namespace stride::scenario {

/// Throws core::Error (Input) with the option where `parse` throws std::invalid_argument.
template <class Parse>
auto parse_option(const std::string& option, const std::string& text, Parse&& parse) {
  try {
    return parse(text);
  } catch (const std::invalid_argument& mistake) {
    core::fail_input({}, fmt::format("{} {}: {}", option, text, mistake.what()));
  }
}

}  // namespace stride::scenario

#endif
