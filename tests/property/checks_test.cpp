// Checks judge as whoever reads signals.csv and events.csv from top to bottom by their definitions,
// in this process, in others and on threads.
#include "master/observe/checks/checks.h"

#include <algorithm>
#include <random>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/system/scenario/check_selection.h"
#include "tests/property/random_system.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using checks::Kind;
using scenario::CheckDeclaration;

namespace {

const unsigned kChecksSystems = kSanitized ? 5 : 40;
constexpr int kChecksOfEachKind = 8;
constexpr Duration kChecksStep = 1ms;
constexpr Time kChecksStop{60ms};

using Table = std::vector<std::vector<std::string>>;

Table table_of(const std::string& csv) {
  Table table;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    table.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) table.back().push_back(field);
  }
  return table;
}

/// What a check comes to: whether it passed, and where it failed.
struct Judgement {
  std::optional<bool> passed;
  std::optional<Time> time{};
  bool operator==(const Judgement&) const = default;
};

std::string text(const Judgement& judgement) {
  return fmt::format("{} {}", judgement.passed ? (*judgement.passed ? "passed" : "failed") : "open",
                     judgement.time ? core::to_text(*judgement.time) : "");
}

/// What was recorded, and judgements of it.
class Records {
 public:
  explicit Records(const Results& results)
      : signals_(table_of(results.signals)), events_(table_of(results.events)) {
    for (const auto& row : signals_) {
      if (&row != &signals_.front()) times_.push_back(time_of(row[0]));
    }
  }

  std::size_t columns() const { return signals_.front().size(); }
  /// Without the unit.
  std::string name(std::size_t column) const {
    const std::string& title = signals_.front()[column];
    return title.substr(0, title.find(" ["));
  }
  const std::vector<Time>& times() const { return times_; }
  bool is_number(std::size_t column) const {
    const std::string& first = value(0, column);
    return first != "true" && first != "false";
  }
  const std::string& value(std::size_t row, std::size_t column) const {
    return signals_[row + 1][column];
  }
  std::vector<std::string> messages() const {
    std::vector<std::string> names;
    for (std::size_t i = 1; i < events_.size(); ++i) {
      const std::string name = message(i);
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
    return names;
  }

  Judgement lasting(const CheckDeclaration& check, std::size_t column) const {
    std::optional<bool> before, after;
    std::size_t points = 0;
    bool was_true = false;
    for (std::size_t row = 0; row < times_.size(); ++row) {
      const bool holds = keeps(check, row, column);
      const bool is_good = holds == (check.kind != Kind::Never);
      if (check.window.from && times_[row] < *check.window.from) {
        before = is_good;
      } else if (check.window.to && times_[row] > *check.window.to) {
        if (!after) after = is_good;
      } else {
        ++points;
        was_true |= holds;
        if (check.kind != Kind::Eventually && !is_good) return {false, times_[row]};
      }
    }
    if (check.kind == Kind::Eventually && was_true) return {true};
    if (points == 0 && before == true && after == true) return {true};
    if (points == 0) return {};
    if (check.kind != Kind::Eventually) return {true};
    return {false, check.window.to.value_or(times_.back())};
  }

  Judgement final(const CheckDeclaration& check, std::size_t column) const {
    if (keeps(check, times_.size() - 1, column)) return {true};
    return {false, times_.back()};
  }

  Judgement count(const CheckDeclaration& check) const {
    std::vector<Time> found;
    for (const auto& [time, name] : messages_in_order()) {
      if (name == check.subject && check.window.contains(time)) found.push_back(time);
    }
    if (found.size() > *check.max) return {false, found[*check.max]};
    if (found.size() < *check.min) return {false, check.window.to.value_or(kChecksStop)};
    return {true};
  }

  /// With repeats: each request has a reply behind it in time, whoever else asked.
  Judgement answer(const CheckDeclaration& check) const {
    const auto all = messages_in_order();
    bool is_open = false;
    std::size_t requests = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].second != check.subject || !check.window.contains(all[i].first)) continue;
      ++requests;
      const Time deadline = all[i].first + check.within;
      const bool is_answered =
          std::any_of(all.begin() + static_cast<long>(i), all.end(), [&](const auto& other) {
            return other.second == check.reply && other.first <= deadline;
          });
      if (is_answered) continue;
      if (deadline <= kChecksStop) return {false, deadline};
      is_open = true;
    }
    return is_open || requests == 0 ? Judgement{} : Judgement{true};
  }

 private:
  static Time time_of(const std::string& seconds) { return time_from_seconds(std::stod(seconds)); }
  std::string message(std::size_t row) const { return events_[row][2] + "." + events_[row][3]; }
  std::vector<std::pair<Time, std::string>> messages_in_order() const {
    std::vector<std::pair<Time, std::string>> all;
    for (std::size_t i = 1; i < events_.size(); ++i) {
      all.emplace_back(time_of(events_[i][0]), message(i));
    }
    return all;
  }
  bool keeps(const CheckDeclaration& check, std::size_t row, std::size_t column) const {
    const checks::ConditionText& condition = check.condition;
    const std::string& found = value(row, column);
    if (condition.equals) return found == *condition.equals;
    const double number = std::stod(found);
    return (!condition.min || number >= std::stod(*condition.min)) &&
           (!condition.below || number < std::stod(*condition.below));
  }

  Table signals_, events_;
  std::vector<Time> times_;
};

/// Checks about what a run has shown, so that limits lie where values are.
class Draw {
 public:
  Draw(const Records& records, unsigned seed) : records_(records), random_(seed) {}

  std::size_t up_to(std::size_t last) {
    return std::uniform_int_distribution<std::size_t>(0, last)(random_);
  }

  checks::Window window() {
    checks::Window window;
    if (up_to(2) > 0) window.from = instant();
    if (up_to(2) > 0) window.to = instant();
    if (window.from && window.to && *window.from > *window.to) std::swap(window.from, window.to);
    return window;
  }

  CheckDeclaration of_signal(Kind kind, std::size_t column) {
    CheckDeclaration check{kind, fmt::format("check {}", ++count_), records_.name(column)};
    const std::string& limit = records_.value(up_to(records_.times().size() - 1), column);
    if (!records_.is_number(column) || up_to(3) == 0) {
      check.condition.equals = limit;
    } else if (up_to(1) == 0) {
      check.condition.min = limit;
    } else {
      check.condition.below = limit;
    }
    if (kind != Kind::Final) check.window = window();
    return check;
  }

  CheckDeclaration of_count(const std::string& message) {
    CheckDeclaration check{Kind::Count, fmt::format("check {}", ++count_), message};
    check.window = window();
    check.min = up_to(10);
    check.max = *check.min + up_to(30);
    return check;
  }

  CheckDeclaration of_answer(const std::string& request, const std::string& reply) {
    CheckDeclaration check{Kind::Answer, fmt::format("check {}", ++count_), request};
    check.reply = reply;
    check.within = Duration(static_cast<std::int64_t>(up_to(20)) * 1ms);
    check.repeats = true;
    check.window = window();
    return check;
  }

 private:
  /// One of the instants that were recorded, or one beside it.
  Time instant() {
    const Time time = records_.times()[up_to(records_.times().size() - 1)];
    return std::min(time + Duration(static_cast<std::int64_t>(up_to(2)) * 1us), kChecksStop);
  }

  const Records& records_;
  std::mt19937 random_;
  int count_ = 0;
};

struct Expected {
  std::vector<CheckDeclaration> checks;
  std::vector<Judgement> judgements;
};

Expected draw(const Records& records, unsigned seed) {
  Draw draw(records, seed);
  Expected expected;
  for (int i = 0; i < kChecksOfEachKind; ++i) {
    for (const Kind kind : {Kind::Always, Kind::Never, Kind::Eventually, Kind::Final}) {
      const std::size_t column = 1 + draw.up_to(records.columns() - 2);
      expected.checks.push_back(draw.of_signal(kind, column));
      expected.judgements.push_back(kind == Kind::Final
                                        ? records.final(expected.checks.back(), column)
                                        : records.lasting(expected.checks.back(), column));
    }
    const std::vector<std::string> messages = records.messages();
    if (messages.size() < 2) continue;
    const std::size_t first = draw.up_to(messages.size() - 1);
    const std::size_t second = (first + 1 + draw.up_to(messages.size() - 2)) % messages.size();
    expected.checks.push_back(draw.of_count(messages[first]));
    expected.judgements.push_back(records.count(expected.checks.back()));
    expected.checks.push_back(draw.of_answer(messages[first], messages[second]));
    expected.judgements.push_back(records.answer(expected.checks.back()));
  }
  return expected;
}

std::vector<core::Verdict> judged(const Assembly& assembly,
                                  const std::vector<CheckDeclaration>& declared,
                                  std::size_t threads = 1) {
  const core::System system(assembly.declaration());
  checks::Checks checks(scenario::select_checks(system, declared, {Time{}, kChecksStop}));
  core::RunOptions options = fixed_steps(kChecksStep, kChecksStop);
  options.watched = checks.signals();
  options.threads = {.count = threads, .always = threads > 1};
  core::Simulation simulation(system, assembly.instantiate(), options);
  simulation.add_observer(checks, checks.signals());
  simulation.run();
  return checks.verdicts({simulation.statistics().reached, true});
}

std::string texts(const std::vector<core::Verdict>& verdicts) {
  std::string all;
  for (const core::Verdict& verdict : verdicts) {
    all += fmt::format("{}: {} {}\n", verdict.name, text({verdict.passed, verdict.time}),
                       verdict.text);
  }
  return all;
}

}  // namespace

TEST_CASE("checks judge as the recorded files do, read by their definitions") {
  int passed = 0;
  int failed = 0;
  int open = 0;
  for (unsigned seed = 0; seed < kChecksSystems; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const Expected expected = draw(Records(run(system, kChecksStep, kChecksStop)), seed);
    const auto verdicts = judged(system, expected.checks);
    REQUIRE(verdicts.size() == expected.judgements.size());
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
      INFO("seed " << seed << ": " << verdicts[i].name << ", " << verdicts[i].kind << " "
                   << expected.checks[i].subject << expected.checks[i].window.text() << "; "
                   << verdicts[i].text);
      CHECK(text({verdicts[i].passed, verdicts[i].time}) == text(expected.judgements[i]));
      passed += verdicts[i].passed == true;
      failed += verdicts[i].passed == false;
      open += !verdicts[i].passed;
    }
  }
  CHECK(passed > 5 * static_cast<int>(kChecksSystems));
  CHECK(failed > 5 * static_cast<int>(kChecksSystems));
  CHECK(open > static_cast<int>(kChecksSystems) / 5);
}

TEST_CASE("threads and hosts change neither a verdict nor its text") {
  for (unsigned seed = 0; seed < kChecksSystems / 10 + 1; ++seed) {
    const Assembly system = random_system(seed, Wiring::Continuous);
    const auto declared = draw(Records(run(system, kChecksStep, kChecksStop)), seed).checks;
    const std::string expected = texts(judged(system, declared));
    CHECK(texts(judged(system, declared, 3)) == expected);
    CHECK(texts(judged(system.hosted(), declared)) == expected);
  }
}
