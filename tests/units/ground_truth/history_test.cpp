#include "units/ground_truth/history.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/at.h"

using ground_truth::History;
using stride::Duration;
using stride::Time;
using namespace std::chrono_literals;

namespace {

constexpr Duration kForEver = 1'000'000s;

using stride::tests::at;

/// All that was noted, and the bounds of an interval by looking at all of it.
struct Told {
  std::vector<std::pair<Time, double>> notes;

  void note(History& history, Time time, double value) {
    history.note(time, value);
    notes.emplace_back(time, value);
  }

  /// Of all values that it had in an interval.
  std::pair<double, double> bounds(Time from, Time to) const {
    std::pair<double, double> bounds{INFINITY, -INFINITY};
    for (std::size_t i = 0; i < notes.size(); ++i) {
      const bool is_over = i + 1 < notes.size() && notes[i + 1].first < from;
      if (is_over || notes[i].first > to) continue;
      bounds.first = std::min(bounds.first, notes[i].second);
      bounds.second = std::max(bounds.second, notes[i].second);
    }
    return bounds;
  }
};

}  // namespace

TEST_CASE("nothing is known before the first instant") {
  History history({}, kForEver);
  CHECK_FALSE(history.between(at(0), at(1)));
  history.note(at(2), 7.0);
  CHECK_FALSE(history.between(at(0), at(1.9)));
  const auto bounds = history.between(at(1), at(2));
  REQUIRE(bounds);
  CHECK((bounds->low == 7.0 && bounds->high == 7.0 && !bounds->is_complete));
  CHECK(history.between(at(2), at(2))->is_complete);
}

TEST_CASE("between two instants the quantity was what it was at the first one") {
  History history({}, kForEver);
  for (const int second : {0, 1, 2, 3}) history.note(at(second), 10.0 * second);
  const auto within = history.between(at(1.4), at(1.6));
  CHECK((within->low == 10.0 && within->high == 10.0 && within->is_complete));
  const auto across = history.between(at(0.5), at(2.5));
  CHECK((across->low == 0.0 && across->high == 20.0));
  const auto late = history.between(at(2.5), at(3));
  CHECK((late->low == 20.0 && late->high == 30.0));
}

TEST_CASE("a jump counts at its instant with both values, and nowhere else") {
  History history({}, kForEver);
  history.note(at(0), 1.0);
  history.note(at(1), 5.0);
  history.note(at(2), 5.0);
  CHECK(history.between(at(0.2), at(0.8))->high == 1.0);
  CHECK(history.between(at(1), at(1))->low == 1.0);
  CHECK(history.between(at(1), at(1))->high == 5.0);
  CHECK(history.between(at(1.2), at(1.8))->low == 5.0);
}

TEST_CASE("what stays as it is takes no memory") {
  History history({}, kForEver);
  for (int i = 0; i < 1000; ++i) history.note(at(i), 21.5);
  CHECK(history.state().pieces.size() == 1);
}

TEST_CASE("a slow course takes as much memory as it goes in grains") {
  History history({0.5, {}}, kForEver);
  for (int i = 0; i <= 10'000; ++i) history.note(at(i), 1e-3 * i);
  CHECK(history.state().pieces.size() <= 21);
  CHECK(history.state().pieces.size() >= 19);
}

TEST_CASE("what is too old is forgotten, and no more than that") {
  History history({}, 10s);
  for (int i = 0; i <= 100; ++i) history.note(at(i), i);
  CHECK(history.state().pieces.size() <= 12);
  CHECK(history.between(at(90), at(100))->is_complete);
  CHECK(history.between(at(90.2), at(90.5))->low == 90.0);
  CHECK_FALSE(history.between(at(80), at(100))->is_complete);
  CHECK_FALSE(history.between(at(80), at(85)));
}

TEST_CASE("a fast course takes as much memory as its time in grains") {
  History history({0.5, 100ms}, kForEver);
  for (int i = 0; i <= 10'000; ++i) history.note(at(1e-3 * i), i % 2 == 0 ? 20.0 : 30.0);
  CHECK(history.state().pieces.size() <= 101);
  CHECK(history.state().pieces.size() >= 99);
}

TEST_CASE("bounds hold what was recorded, and are too wide by the grain at most") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    const double grain = seed % 3 == 0 ? 0.0 : uniform(0.0, 2.0);
    const Duration reach = stride::duration_from_seconds(seed % 2 == 0 ? 0.0 : uniform(0.0, 2.0));
    History history({grain, reach}, kForEver);
    Told told;
    Time now = at(1);
    double value = 0.0;
    for (int i = 0; i < 200; ++i) {
      told.note(history, now, value);
      if (uniform(0, 1) < 0.8) now += stride::duration_from_seconds(uniform(0.001, 1));
      if (uniform(0, 1) < 0.7) value += uniform(-1, 1);
      if (uniform(0, 1) < 0.05) value += uniform(-10, 10);
    }
    told.note(history, now, value);
    for (int i = 0; i < 50; ++i) {
      const Time to = at(uniform(1, stride::to_seconds(now)));
      const Time from = at(uniform(1, stride::to_seconds(to)));
      const auto bounds = history.between(from, to);
      const auto [low, high] = told.bounds(from, to);
      REQUIRE(bounds);
      REQUIRE(bounds->is_complete);
      REQUIRE(bounds->low <= low);
      REQUIRE(bounds->high >= high);
      const auto [least, most] = told.bounds(std::max(at(1), from - reach), to + reach);
      REQUIRE(bounds->low >= least - grain);
      REQUIRE(bounds->high <= most + grain);
    }
  }
}

TEST_CASE("it does not matter how often a value is noted that stays") {
  for (unsigned seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    const Duration reach = stride::duration_from_seconds(seed % 2 == 0 ? 0.0 : uniform(0.0, 3.0));
    const Duration length = stride::duration_from_seconds(uniform(0.0, 20.0));
    History rarely({0.3, reach}, length);
    History often({0.3, reach}, length);
    double value = 0.0;
    for (double now = 0.0; now < 100.0;) {
      rarely.note(at(now), value);
      const double next = now + uniform(0.001, 2);
      for (; now < next; now += uniform(0.01, 0.2)) often.note(at(now), value);
      now = next;
      value += uniform(-1, 1);
      rarely.note(at(now), value);
      often.note(at(now), value);
      const double to = uniform(std::max(0.0, now - 25.0), now);
      const double from = uniform(std::max(0.0, to - 5.0), to);
      const auto one = rarely.between(at(from), at(to));
      const auto other = often.between(at(from), at(to));
      REQUIRE(one.has_value() == other.has_value());
      if (!one) continue;
      REQUIRE(one->low == other->low);
      REQUIRE(one->high == other->high);
      REQUIRE(one->is_complete == other->is_complete);
    }
  }
}
