#include "master/study/compare/comparison_json.h"

#include <chrono>
#include <optional>

#include "master/base/files/replacement.h"

namespace stride::compare {
namespace {

using report::Json;

constexpr int kVersion = 1;

template <class TimeOrDuration>
Json time_entry(std::optional<TimeOrDuration> time) {
  return time ? Json(to_seconds(*time)) : Json();
}

Json extreme_entry(const std::optional<Extreme>& extreme) {
  if (!extreme) return {};
  return {{"value", extreme->value},
          {"time", to_seconds(extreme->time)},
          {"a", extreme->a},
          {"b", extreme->b}};
}

Json difference_entry(const Difference& difference) {
  return {{"kind", name(difference.kind)},
          {"name", difference.name},
          {"time", time_entry(difference.time)},
          {"a", difference.a},
          {"b", difference.b},
          {"count", difference.count},
          {"absolute", extreme_entry(difference.absolute)},
          {"relative", extreme_entry(difference.relative)}};
}

Json settings_entry(const Settings& settings) {
  Json signals = Json::array();
  for (const SignalTolerance& rule : settings.tolerances) {
    signals.push_back({{"signal", rule.pattern},
                       {"absolute", rule.tolerance.absolute},
                       {"relative", rule.tolerance.relative}});
  }
  return {{"absolute", settings.tolerance.absolute},
          {"relative", settings.tolerance.relative},
          {"signals", std::move(signals)},
          {"time", time_entry(settings.time_tolerance)},
          {"only", settings.only},
          {"ignored", settings.ignored},
          {"golden", settings.is_golden}};
}

Json input_entries(const std::optional<std::vector<InputDifference>>& inputs) {
  if (!inputs) return {};
  Json entries = Json::array();
  for (const InputDifference& input : *inputs) {
    entries.push_back({{"kind", input.kind}, {"name", input.name}, {"a", input.a}, {"b", input.b}});
  }
  return entries;
}

}  // namespace

Json comparison_json(const Comparison& comparison, const Settings& settings) {
  Json differences = Json::array();
  for (const Difference& difference : comparison.differences) {
    differences.push_back(difference_entry(difference));
  }
  return {{"format", "stride comparison"},
          {"version", kVersion},
          {"a", comparison.a.string()},
          {"b", comparison.b.string()},
          {"equal", comparison.differences.empty()},
          {"settings", settings_entry(settings)},
          {"compared",
           {{"signals", comparison.signals},
            {"rows", comparison.rows},
            {"messages", comparison.messages}}},
          {"differences", std::move(differences)},
          {"inputs", input_entries(comparison.inputs)},
          {"notes", comparison.notes},
          {"not_compared", kNotCompared}};
}

void write_comparison(const std::filesystem::path& file, const Comparison& comparison,
                      const Settings& settings) {
  core::Replacement output(file);
  output.file().write(
      comparison_json(comparison, settings).dump(2, ' ', false, Json::error_handler_t::replace));
  output.file().write('\n');
  output.commit();
}

}  // namespace stride::compare
