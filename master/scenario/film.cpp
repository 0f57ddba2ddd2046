#include "master/scenario/film.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "master/util/time_text.h"

namespace stride::scenario {
namespace {

constexpr const char* kDefaultInterval = "0.1";

void check_interval(const std::string& text) {
  std::string mistake = "expected a time above 0";
  try {
    if (core::parse_seconds(text) > Duration{}) return;
  } catch (const std::invalid_argument& error) {
    mistake = error.what();
  }
  core::fail_input({}, fmt::format("--film={}: {}", text, mistake), "such as --film=0.1");
}

bool makes_films(const core::UnitDescription& unit) {
  const auto found = unit.find(kFilmInterval);
  return found && unit.variables[*found].causality == core::Causality::Parameter;
}

}  // namespace

void switch_film_on(core::SystemDeclaration& system, const std::string& interval) {
  const bool is_default = interval == kUnspecifiedFilmInterval;
  if (!is_default) check_interval(interval);
  std::vector<core::StartDeclaration> values;
  for (const core::ComponentDeclaration& component : system.components) {
    if (!makes_films(*component.description)) continue;
    core::StartDeclaration& value = values.emplace_back();
    value.component = component.name;
    value.variable = kFilmInterval;
    value.value = is_default ? kDefaultInterval : interval;
    value.where = {"--film", 0};
  }
  if (values.empty()) {
    core::fail_input(
        {}, "--film: no component makes pictures",
        fmt::format("a unit that does, such as mujoco_world, has the parameter {}", kFilmInterval));
  }
  // a later value replaces an earlier one
  auto& all = system.start_values;
  all.insert(is_default ? all.begin() : all.end(), values.begin(), values.end());
}

}  // namespace stride::scenario
