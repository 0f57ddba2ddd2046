// Margins are what their definitions say, evaluated by brute force over all that a check has seen;
// their signs agree with the verdicts; and a check that is resumed anywhere has the same.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <stdexcept>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/observe/checks/message_checks.h"
#include "master/observe/checks/signal_check.h"
#include "master/observe/checks/until_check.h"
#include "tests/build.h"
#include "tests/master/observe/checks/support.h"

using namespace stride;
using namespace stride::checks;
using core::ValueType;

namespace {

const unsigned kMarginRounds = tests::kSanitized ? 1'000 : 20'000;
constexpr long double kFarthest = std::numeric_limits<long double>::infinity();

class MarginDraw {
 public:
  explicit MarginDraw(unsigned seed) : random_(seed) {}

  std::int64_t between(std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random_);
  }
  bool one_in(std::int64_t count) { return between(1, count) == 1; }
  template <class T>
  const T& one_of(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(between(0, static_cast<std::int64_t>(all.size()) - 1))];
  }
  /// Some of them lie outside of the run.
  Window window(std::int64_t last) {
    std::optional<std::int64_t> from, to;
    if (!one_in(3)) from = between(0, last);
    if (!one_in(3)) to = between(from.value_or(0), last + 2);
    return checks::window(from, to);
  }

 private:
  std::mt19937 random_;
};

/// A margin and where it is; nothing where the check is undecided.
struct ExpectedMargin {
  double value = 0;
  Time at{};
};

int passed_margins = 0, failed_margins = 0, no_margins = 0, zero_margins = 0;

void check_margin(const core::Verdict& verdict, const ExpectedMargin& expected) {
  INFO(verdict.kind << ": " << text_of(verdict));
  REQUIRE(verdict.margin.has_value() == verdict.passed.has_value());
  if (!verdict.margin) {
    ++no_margins;
    return;
  }
  const double found = verdict.margin->value;
  CHECK_FALSE(std::isnan(found));
  if (*verdict.passed) CHECK((found >= 0 && !std::signbit(found)));
  if (!*verdict.passed) CHECK(found <= 0);
  // with a tolerance there are two differences to be rounded
  if (found != expected.value) CHECK(found == Approx(expected.value).epsilon(1e-15));
  CHECK(core::to_text(verdict.margin->at) == core::to_text(expected.at));
  ++(*verdict.passed ? passed_margins : failed_margins);
  zero_margins += found == 0;
}

void check_all_kinds_of_ends() {
  const int least = static_cast<int>(kMarginRounds) / 20;
  CHECK(passed_margins > least);
  CHECK(failed_margins > least);
  CHECK(no_margins > least);
  CHECK(zero_margins > least / 10);
  passed_margins = failed_margins = no_margins = zero_margins = 0;
}

// ---- Signals ----

struct SignalSample {
  std::int64_t time = 0;  // ms
  long double value = 0;
};

/// Types with the numbers that are hard for them; all bounds are exact in decimals.
struct HardNumbers {
  ValueType type;
  std::vector<long double> hard;
  long double middle, grid;
};

std::vector<HardNumbers> all_numbers() {
  using Limits = std::numeric_limits<double>;
  const double inf = Limits::infinity();
  return {{ValueType::Float64,
           {Limits::quiet_NaN(), inf, -inf, Limits::denorm_min(), -Limits::denorm_min(),
            Limits::max(), Limits::lowest(), std::nextafter(1, 2), std::nextafter(1, 0)},
           0,
           0.125L},
          {ValueType::Float32, {std::nanf(""), inf, std::nextafterf(1, 2)}, 0, 0.125L},
          {ValueType::Int8, {-128, 127}, 0, 1},
          {ValueType::Int64, {}, static_cast<long double>(std::int64_t{1} << 62), 1},
          {ValueType::UInt64, {0}, 16, 1}};
}

void put_number(core::ValueBlock& block, long double value) {
  core::visit(block, [&](auto values) {
    using T = typename decltype(values)::value_type;
    if constexpr (std::is_arithmetic_v<T>) values[0] = static_cast<T>(value);
  });
}

/// In decimals that are exact for the grids.
std::string bound_text(const HardNumbers& numbers, long double value) {
  return fmt::format("{:.{}f}", value, core::is_real(numbers.type) ? 3 : 0);
}

/// Of bounds that exclude each other another draw is made.
std::unique_ptr<Condition> draw_condition(MarginDraw& draw, const HardNumbers& numbers,
                                          ConditionText& text) {
  const auto bound = [&] {
    return bound_text(
        numbers, numbers.middle + numbers.grid * static_cast<long double>(draw.between(-12, 12)));
  };
  for (;;) {
    text = {};
    if (draw.one_in(4)) {
      text.equals = bound();
      if (core::is_real(numbers.type) && draw.one_in(2)) {
        text.tolerance = bound_text(numbers, 0.125L * static_cast<long double>(draw.between(0, 8)));
      }
    } else {
      for (auto* const attribute : {&text.min, &text.max, &text.above, &text.below}) {
        if (draw.one_in(3)) *attribute = bound();
      }
    }
    try {
      return std::make_unique<Condition>(variable(numbers.type, "V"), text);
    } catch (const std::invalid_argument&) {
    }
  }
}

/// The signed distance, from the definition.
long double distance_of(const ConditionText& text, long double value) {
  if (std::isnan(value)) return -kFarthest;
  long double least = kFarthest;
  const auto add = [&](long double distance) { least = std::min(least, distance); };
  if (text.min) add(value - std::stold(*text.min));
  if (text.above) add(value - std::stold(*text.above));
  if (text.max) add(std::stold(*text.max) - value);
  if (text.below) add(std::stold(*text.below) - value);
  if (text.equals) {
    const long double tolerance = text.tolerance ? std::stold(*text.tolerance) : 0;
    add(tolerance - std::abs(value - std::stold(*text.equals)));
  }
  return least;
}

ExpectedMargin signal_margin(const Definition& definition, const ConditionText& text,
                             const std::vector<SignalSample>& samples) {
  const auto of = [&](const SignalSample& sample) -> ExpectedMargin {
    const long double distance = distance_of(text, sample.value);
    const bool is_opposite = definition.kind == Kind::Never && !std::isnan(sample.value);
    return {static_cast<double>(is_opposite ? -distance : distance), at(sample.time)};
  };
  const auto is_less = [](const ExpectedMargin& a, const ExpectedMargin& b) {
    return a.value < b.value;
  };
  std::vector<ExpectedMargin> inside, before, behind;
  for (const SignalSample& sample : samples) {
    const Window& window = definition.window;
    (!window.has_begun(at(sample.time)) ? before
     : window.is_past(at(sample.time))  ? behind
                                        : inside)
        .push_back(of(sample));
  }
  if (inside.empty()) {
    if (before.empty() || behind.empty()) return {};
    return std::min(before.back(), behind.front(), is_less);
  }
  if (definition.kind == Kind::Final) return inside.back();
  if (definition.kind == Kind::Eventually) return *std::ranges::max_element(inside, is_less);
  return *std::ranges::min_element(inside, is_less);
}

std::vector<SignalSample> draw_signal(MarginDraw& draw, const HardNumbers& numbers) {
  std::vector<SignalSample> samples;
  std::int64_t time = 0;
  const bool is_hard = !numbers.hard.empty() && draw.one_in(3);
  const std::int64_t middle = draw.between(-10, 10);
  for (std::int64_t count = draw.between(1, 25); count > 0; --count) {
    const auto place =
        static_cast<long double>(std::clamp<std::int64_t>(middle + draw.between(-6, 6), -16, 16));
    samples.push_back({time, is_hard && draw.one_in(6) ? draw.one_of(numbers.hard)
                                                       : numbers.middle + numbers.grid * place});
    time += draw.between(1, 4);
  }
  return samples;
}

core::Verdict judge_signal(const Definition& definition, const HardNumbers& numbers,
                           const std::vector<SignalSample>& samples, std::size_t cut,
                           bool is_complete) {
  core::ValueBlock block(numbers.type, 1);
  SignalCheck first(definition), second(definition);
  SignalCheck* check = &first;
  const core::Signal signal{{0, 0}, &block, 0};
  for (SignalCheck* const each : {&first, &second}) each->attach({&signal, 1});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == cut) take_over(second, first), check = &second;
    put_number(block, samples[i].value);
    check->on_point(at(samples[i].time));
  }
  return check->verdict({at(samples.back().time), is_complete});
}

// ---- Until ----

/// At one instant, of the signal that keeps to a condition, and of the one that ends this.
struct UntilSample {
  std::int64_t time = 0;  // ms
  long double holds = 0, ends = 0;
};
struct UntilTexts {
  ConditionText holds, ends;
};

/// Tries each communication point as the one that ends it.
ExpectedMargin until_margin(const Window& window, const UntilTexts& texts,
                            const std::vector<UntilSample>& samples) {
  std::vector<ExpectedMargin> all, held;
  for (const UntilSample& sample : samples) {
    if (!window.contains(at(sample.time))) continue;
    const auto distance = [&](const ConditionText& text, long double value) -> ExpectedMargin {
      return {static_cast<double>(distance_of(text, value)), at(sample.time)};
    };
    ExpectedMargin least = distance(texts.ends, sample.ends);
    for (auto before = held.rbegin(); before != held.rend(); ++before) {
      const bool is_of_holds = least.at != at(sample.time);
      if (before->value < least.value || (is_of_holds && before->value == least.value)) {
        least = *before;
      }
    }
    all.push_back(least);
    held.push_back(distance(texts.holds, sample.holds));
  }
  if (all.empty()) return {};
  return *std::ranges::max_element(all, {}, &ExpectedMargin::value);
}

core::Verdict judge_until(const Definition& definition, const HardNumbers& numbers,
                          const std::vector<UntilSample>& samples, std::size_t cut,
                          bool is_complete) {
  core::ValueBlock holds(numbers.type, 1), ends(numbers.type, 1);
  UntilCheck first(definition), second(definition);
  UntilCheck* check = &first;
  const core::Signal signals[] = {{{0, 0}, &holds, 0}, {{0, 1}, &ends, 0}};
  for (UntilCheck* const each : {&first, &second}) each->attach(signals);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i == cut) take_over(second, first), check = &second;
    put_number(holds, samples[i].holds);
    put_number(ends, samples[i].ends);
    check->on_point(at(samples[i].time));
  }
  return check->verdict({at(samples.back().time), is_complete});
}

std::vector<UntilSample> draw_until(MarginDraw& draw, const HardNumbers& numbers) {
  std::vector<UntilSample> samples;
  const auto others = draw_signal(draw, numbers);
  for (const SignalSample& sample : draw_signal(draw, numbers)) {
    const std::size_t place = samples.size() % others.size();
    samples.push_back({sample.time, sample.value, others[place].value});
  }
  return samples;
}

// ---- Messages ----

constexpr std::size_t kRequest = 1, kReply = 2;

/// Messages in order, and communication points: of place 0.
struct SeenEvent {
  std::int64_t time = 0;
  std::size_t place = 0;
};

std::vector<SeenEvent> draw_events(MarginDraw& draw) {
  std::vector<SeenEvent> events;
  std::int64_t time = 0;
  const std::int64_t rarity = draw.between(1, 6);
  for (std::int64_t count = draw.between(0, 20); count > 0; --count) {
    while (draw.one_in(2)) {
      events.push_back({time, draw.one_in(rarity) ? kRequest : kReply});
    }
    events.push_back({time, 0});
    time += draw.between(1, 3);
  }
  events.push_back({time, 0});
  return events;
}

template <class MessageCheck>
core::Verdict judge_messages(const Definition& definition, const std::vector<SeenEvent>& events,
                             std::size_t cut, bool is_complete) {
  MessageCheck first(definition), second(definition);
  MessageCheck* check = &first;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (i == cut) take_over(second, first), check = &second;
    if (events[i].place == 0) {
      check->on_point(at(events[i].time));
    } else {
      check->on_message(message(events[i].time, events[i].place));
    }
  }
  return check->verdict({at(events.back().time), is_complete});
}

struct AskedRequest {
  Time deadline;
  std::optional<Time> answered{};
};

/// Which reply answers which request, found by looking at all of them.
std::vector<AskedRequest> all_asked(const Definition& definition,
                                    const std::vector<SeenEvent>& events) {
  const auto& demand = std::get<AnswerDemand>(definition.what);
  std::vector<AskedRequest> asked;
  for (const SeenEvent& event : events) {
    const Time now = at(event.time);
    const auto is_open = [&](const AskedRequest& one) {
      return !one.answered && one.deadline >= now;
    };
    const auto is_left = [](const AskedRequest& one) { return !one.answered; };
    const auto open = std::ranges::find_if(asked, is_open);
    if (event.place == kReply && demand.repeats) {
      for (AskedRequest& one : asked) one.answered = one.answered.value_or(now);
    } else if (event.place == kReply) {
      const auto one = open != asked.end() ? open : std::ranges::find_if(asked, is_left);
      if (one != asked.end()) one->answered = now;
    } else if (event.place == kRequest && definition.window.contains(now)) {
      if (!demand.repeats || open == asked.end()) asked.push_back({now + demand.within});
    }
  }
  return asked;
}

ExpectedMargin answer_margin(const Definition& definition, const std::vector<SeenEvent>& events) {
  const Time reached = at(events.back().time);
  std::vector<ExpectedMargin> margins;
  for (const AskedRequest& one : all_asked(definition, events)) {
    const Time until = one.answered.value_or(reached);
    margins.push_back({to_seconds(one.deadline - until), until});
  }
  if (margins.empty()) return {};
  return *std::ranges::min_element(margins, [](const ExpectedMargin& a, const ExpectedMargin& b) {
    return a.value < b.value || (a.value == b.value && a.at < b.at);
  });
}

ExpectedMargin count_margin(const Definition& definition, const std::vector<SeenEvent>& events) {
  const auto& demand = std::get<CountDemand>(definition.what);
  const auto count = std::ranges::count_if(events, [&](const SeenEvent& event) {
    return event.place == kRequest && definition.window.contains(at(event.time));
  });
  const Time reached = at(events.back().time);
  double least = std::numeric_limits<double>::infinity();
  if (demand.max) least = static_cast<double>(*demand.max) - static_cast<double>(count);
  if (demand.min) {
    least = std::min(least, static_cast<double>(count) - static_cast<double>(*demand.min));
  }
  return {least, std::min(definition.window.to.value_or(reached), reached)};
}

CountDemand draw_count(MarginDraw& draw) {
  CountDemand demand{{0, kRequest}};
  const auto least = static_cast<std::uint64_t>(draw.between(0, 6));
  if (!draw.one_in(3)) demand.min = least;
  if (!demand.min || draw.one_in(2)) {
    demand.max = least + static_cast<std::uint64_t>(draw.between(0, 6));
  }
  return demand;
}

}  // namespace

TEST_CASE("margins of signals are those of a brute-force evaluation") {
  const std::vector<HardNumbers> all = all_numbers();
  for (unsigned seed = 0; seed < kMarginRounds; ++seed) {
    MarginDraw draw(seed);
    const HardNumbers& numbers = draw.one_of(all);
    ConditionText text;
    const auto condition = draw_condition(draw, numbers, text);
    const std::vector<SignalSample> samples = draw_signal(draw, numbers);
    const Kind kind = draw.one_of<Kind>({Kind::Always, Kind::Never, Kind::Eventually, Kind::Final});
    const Window of = kind == Kind::Final ? Window{} : draw.window(samples.back().time);
    const Definition definition{kind, "x", "",
                                of,   {},  SignalDemand{{0, 0}, 0, "a.x", "V", *condition}};
    const bool is_complete = !draw.one_in(4);
    const auto verdict = judge_signal(definition, numbers, samples, samples.size(), is_complete);
    INFO("seed " << seed << ": " << condition->text() << of.text());
    check_margin(verdict, signal_margin(definition, text, samples));
    const auto cut = static_cast<std::size_t>(draw.between(0, 24));
    CHECK(text_of(judge_signal(definition, numbers, samples, cut, is_complete)) ==
          text_of(verdict));
  }
  check_all_kinds_of_ends();
}

TEST_CASE("margins of until are those of a brute-force evaluation") {
  const std::vector<HardNumbers> all = all_numbers();
  for (unsigned seed = 0; seed < kMarginRounds; ++seed) {
    MarginDraw draw(seed);
    const HardNumbers& numbers = draw.one_of(all);
    UntilTexts texts;
    const auto holds = draw_condition(draw, numbers, texts.holds);
    const auto ends = draw_condition(draw, numbers, texts.ends);
    const std::vector<UntilSample> samples = draw_until(draw, numbers);
    const Window of = draw.window(samples.back().time);
    const Definition definition{
        Kind::Until, "x",
        "",          of,
        {},          UntilDemand{{{0, 0}, 0, "a.x", "V", *holds}, {{0, 1}, 0, "a.y", "V", *ends}}};
    const bool is_complete = !draw.one_in(4);
    const auto verdict = judge_until(definition, numbers, samples, samples.size(), is_complete);
    INFO("seed " << seed << ": " << holds->text() << " until " << ends->text() << of.text());
    check_margin(verdict, until_margin(of, texts, samples));
    const auto cut = static_cast<std::size_t>(draw.between(0, 24));
    CHECK(text_of(judge_until(definition, numbers, samples, cut, is_complete)) == text_of(verdict));
  }
  check_all_kinds_of_ends();
}

TEST_CASE("margins of answers are those of a brute-force evaluation") {
  for (unsigned seed = 0; seed < kMarginRounds; ++seed) {
    MarginDraw draw(seed);
    const std::vector<SeenEvent> events = draw_events(draw);
    const Window of = draw.one_in(2) ? Window{} : draw.window(events.back().time);
    const Duration within = at(draw.between(0, 12)) - Time{};
    const Definition definition{
        Kind::Answer, "x", "",
        of,           {},  AnswerDemand{{0, kRequest}, {0, kReply}, within, draw.one_in(2)}};
    const bool is_complete = !draw.one_in(4);
    const auto verdict =
        judge_messages<AnswerCheck>(definition, events, events.size(), is_complete);
    INFO("seed " << seed << ": within " << core::to_text(within) << " s" << of.text());
    check_margin(verdict, answer_margin(definition, events));
    const auto cut = static_cast<std::size_t>(draw.between(0, 20));
    CHECK(text_of(judge_messages<AnswerCheck>(definition, events, cut, is_complete)) ==
          text_of(verdict));
  }
  check_all_kinds_of_ends();
}

TEST_CASE("margins of counts are those of a brute-force evaluation") {
  for (unsigned seed = 0; seed < kMarginRounds; ++seed) {
    MarginDraw draw(seed);
    const std::vector<SeenEvent> events = draw_events(draw);
    const Window of = draw.window(events.back().time);
    const Definition definition{Kind::Count, "x", "", of, {}, draw_count(draw)};
    const bool is_complete = !draw.one_in(4);
    const auto verdict = judge_messages<CountCheck>(definition, events, events.size(), is_complete);
    INFO("seed " << seed << of.text());
    check_margin(verdict, count_margin(definition, events));
    const auto cut = static_cast<std::size_t>(draw.between(0, 20));
    CHECK(text_of(judge_messages<CountCheck>(definition, events, cut, is_complete)) ==
          text_of(verdict));
  }
  check_all_kinds_of_ends();
}
