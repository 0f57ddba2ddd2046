#include "master/engine/run/verdict.h"

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::core {
namespace {

ValueBlock read(const UnitDescription& description, std::size_t variable, Unit& unit) {
  ValueBlock value(description.variables[variable].type, 1);
  unit.get({&description.variables[variable].reference, 1}, value);
  return value;
}

}  // namespace

std::string to_text(const Margin& margin) {
  return fmt::format("{}{}{}", margin.value, margin.unit.empty() ? "" : " ", margin.unit);
}

std::string brief_text(const Margin& margin) {
  return fmt::format("{:.4g}{}{}", margin.value, margin.unit.empty() ? "" : " ", margin.unit);
}

std::string reason(const Verdict& verdict) {
  if (!verdict.time) return verdict.text;
  const std::string at = "at " + to_text(*verdict.time) + " s";
  return verdict.text.empty() ? at : at + ": " + verdict.text;
}

std::vector<Verdict> undecided_verdicts(const System& system) {
  std::vector<Verdict> verdicts;
  for (const Component& component : system.components()) {
    if (component.description->verdict) verdicts.push_back({component.name, {}});
  }
  return verdicts;
}

std::vector<Verdict> read_verdicts(const System& system,
                                   std::span<const std::unique_ptr<Unit>> units) {
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const UnitDescription& description = *system.components()[i].description;
    if (!description.verdict) continue;
    Verdict& verdict = verdicts.emplace_back();
    verdict.name = system.components()[i].name;
    verdict.passed = read(description, *description.verdict, *units[i]).numbers<bool>()[0];
    if (!description.verdict_text) continue;
    verdict.text = read(description, *description.verdict_text, *units[i]).strings()[0];
  }
  return verdicts;
}

}  // namespace stride::core
