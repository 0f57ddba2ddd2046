#include "master/study/verify/recording.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/error.h"
#include "master/base/time_text.h"
#include "master/study/verify/deviation.h"

namespace stride::verify {
namespace {

using Json = nlohmann::json;

std::string shortened(const std::string& text) {
  constexpr std::size_t kMost = 60;
  return text.size() <= kMost ? text : text.substr(0, kMost) + "…";
}

std::string describe(const Row& row) {
  std::string text;
  for (const std::string& value : row.values) text += (text.empty() ? "" : ", ") + value;
  return shortened(text);
}

std::string compare(const std::vector<std::string>& names, const Row& expected, const Row& seen,
                    const std::string& expected_when, const std::string& seen_when) {
  const std::string at = fmt::format("at {} s ", core::to_text(expected.time));
  if (expected.time != seen.time || expected.is_event != seen.is_event) {
    const auto what = [](const Row& row) {
      return fmt::format("{} at {} s", row.is_event ? "the event " + describe(row) : "no event",
                         core::to_text(row.time));
    };
    return fmt::format("there is {} {}, and {} {}", what(expected), expected_when, what(seen),
                       seen_when);
  }
  if (expected.is_event) {
    return at + fmt::format("the event {} is {} {}", describe(expected), describe(seen), seen_when);
  }
  const auto [here, there] = std::mismatch(expected.values.begin(), expected.values.end(),
                                           seen.values.begin(), seen.values.end());
  const auto place = static_cast<std::size_t>(here - expected.values.begin());
  std::size_t others = 0;
  for (std::size_t i = place + 1; i < expected.values.size(); ++i) {
    others += expected.values[i] != seen.values[i] ? 1U : 0U;
  }
  return at + fmt::format("'{}' is {} {}, and {} {}{}", names[place], shortened(*here),
                          expected_when, shortened(*there), seen_when,
                          others > 0 ? fmt::format(" ({} more differ)", others) : "");
}

std::vector<Row> without_events(const std::vector<Row>& rows) {
  std::vector<Row> rest;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(rest),
               [](const Row& row) { return !row.is_event; });
  return rest;
}

/// The largest difference; 1 where the events differ.
double worst_deviation(const TestedUnit& tested, const std::vector<Row>& expected,
                       const std::vector<Row>& seen) {
  const auto is_other_event = [](const Row& one, const Row& other) {
    return one.is_event != other.is_event || (one.is_event && one != other);
  };
  if (!std::equal(expected.begin(), expected.end(), seen.begin(), seen.end(),
                  std::not_fn(is_other_event))) {
    return 1;
  }
  return deviation(observed_names(tested), without_events(expected), without_events(seen)).worst;
}

std::string size_text(double worst) {
  return fmt::format("all differences are within {:.0e} of the variables' largest values", worst);
}

}  // namespace

Recording Recording::without_events() const { return {verify::without_events(rows)}; }

std::vector<std::string> observed_names(const TestedUnit& tested) {
  std::vector<std::string> names;
  for (const TestedUnit::Group& group : tested.observed()) {
    for (const std::size_t i : group.places) {
      names.push_back(tested.description().variables[i].name);
    }
  }
  return names;
}

std::optional<std::string> difference(const TestedUnit& tested, const std::vector<Row>& expected,
                                      const std::vector<Row>& seen,
                                      const std::string& expected_when,
                                      const std::string& seen_when) {
  const std::size_t common = std::min(expected.size(), seen.size());
  for (std::size_t i = 0; i < common; ++i) {
    if (expected[i] == seen[i]) continue;
    constexpr double kSmall = 1e-4;  // what may be the inaccuracy of a solver
    const double worst = worst_deviation(tested, expected, seen);
    return compare(observed_names(tested), expected[i], seen[i], expected_when, seen_when) +
           (worst < kSmall ? "; " + size_text(worst) : "");
  }
  if (expected.size() == seen.size()) return std::nullopt;
  const bool is_shorter = seen.size() < expected.size();
  const std::string end = common > 0 ? core::to_text(expected[common - 1].time) : std::string("0");
  return fmt::format("nothing follows after {} s {}, but something does {}", end,
                     is_shorter ? seen_when : expected_when,
                     is_shorter ? expected_when : seen_when);
}

std::optional<std::string> difference_beyond_rounding(
    const TestedUnit& tested, const std::vector<Row>& expected, const std::vector<Row>& seen,
    const std::string& expected_when, const std::string& seen_when, std::string& note) {
  auto differs = difference(tested, expected, seen, expected_when, seen_when);
  if (!differs || worst_deviation(tested, expected, seen) > kRounding) return differs;
  note = *differs;
  return std::nullopt;
}

std::string to_text(const Recording& recording) {
  Json rows = Json::array();
  for (const Row& row : recording.rows) {
    rows.push_back({core::to_text(row.time), row.is_event, row.values});
  }
  Json steps = Json::array();
  for (const StepOutcome& step : recording.steps) {
    steps.push_back({core::to_text(step.begin), core::to_text(step.end), step.is_rejected,
                     step.needs_event, step.ends_run});
  }
  return Json{{"rows", std::move(rows)},
              {"steps", std::move(steps)},
              {"counts", {recording.rejections, recording.early_returns, recording.events}},
              {"first early return", core::to_text(recording.first_early_return)},
              {"longest promise", recording.longest_promise == Duration::max()
                                      ? Json()
                                      : Json(core::to_text(recording.longest_promise))},
              {"longest suspension", core::to_text(recording.longest_suspension)},
              {"ended", recording.has_ended}}
      .dump(-1, ' ', true, Json::error_handler_t::replace);
}

namespace {

Time time_of(const Json& text) { return core::parse_time(text.get<std::string>()); }
Duration duration_of(const Json& text) { return core::parse_seconds(text.get<std::string>()); }

}  // namespace

Recording recording_from_text(const std::string& text) {
  const Json json = Json::parse(text);
  Recording recording;
  for (const Json& row : json["rows"]) {
    recording.rows.push_back(
        {time_of(row[0]), row[2].get<std::vector<std::string>>(), row[1].get<bool>()});
  }
  for (const Json& step : json["steps"]) {
    recording.steps.push_back({time_of(step[0]), time_of(step[1]), step[2], step[3], step[4]});
  }
  recording.rejections = json["counts"][0];
  recording.early_returns = json["counts"][1];
  recording.events = json["counts"][2];
  recording.first_early_return = time_of(json["first early return"]);
  const Json& promise = json["longest promise"];
  recording.longest_promise = promise.is_null() ? Duration::max() : duration_of(promise);
  recording.longest_suspension = duration_of(json["longest suspension"]);
  recording.has_ended = json["ended"];
  return recording;
}

}  // namespace stride::verify
