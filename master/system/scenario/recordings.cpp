#include "master/system/scenario/recordings.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::scenario {
namespace {

constexpr const char* kDefaultInterval = "0.1";

void check_interval(const RecordingKind& kind, const std::string& text) {
  std::string mistake = "expected a time above 0";
  try {
    if (core::parse_seconds(text) > Duration{}) return;
  } catch (const std::invalid_argument& error) {
    mistake = error.what();
  }
  core::fail_input({}, fmt::format("{}={}: {}", kind.option, text, mistake),
                   fmt::format("such as {}=0.1", kind.option));
}

bool has_parameter(const core::UnitDescription& unit, std::string_view name) {
  const auto found = unit.find(std::string(name));
  return found && unit.variables[*found].causality == core::Causality::Parameter;
}

}  // namespace

void switch_on(const RecordingKind& kind, core::SystemDeclaration& system,
               const std::string& interval) {
  if (interval.empty()) return;
  const bool is_default = interval == kUnspecifiedInterval;
  if (!is_default) check_interval(kind, interval);
  std::vector<core::StartDeclaration> values;
  for (const core::ComponentDeclaration& component : system.components) {
    if (!has_parameter(*component.description, kind.parameter)) continue;
    core::StartDeclaration& value = values.emplace_back();
    value.component = component.name;
    value.variable = kind.parameter;
    value.value = is_default ? kDefaultInterval : interval;
    value.where = {std::string(kind.option), 0};
  }
  if (values.empty()) {
    core::fail_input({}, fmt::format("{}: no component {}", kind.option, kind.what),
                     fmt::format("a unit that does, such as mujoco_world, has the parameter {}",
                                 kind.parameter));
  }
  // a later value replaces an earlier one
  auto& all = system.start_values;
  all.insert(is_default ? all.begin() : all.end(), values.begin(), values.end());
}

}  // namespace stride::scenario
