#include "master/loader/fmu/instance/state_hint.h"

#include <fmt/format.h>

namespace stride::importer {

std::string state_hint(const std::string& unit) {
  return fmt::format(
      "<stride:StateSaving components=\"{}\" allowed=\"false\"/> lets it run without its own "
      "functions for its state",
      unit);
}

std::string state_hint(std::string_view failure, const std::string& unit) {
  const auto names = [&](std::string_view function) {
    return failure.find(function) != std::string_view::npos;
  };
  return names("FMUstate") || names("FMUState") ? state_hint(unit) : "";
}

}  // namespace stride::importer
