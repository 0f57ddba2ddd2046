#include "master/report/signals_file.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/at.h"
#include "tests/master/report/support.h"

using namespace stride::report;
using Catch::Contains;
using stride::core::ValueType;
using stride::tests::at;
using stride::tests::at_picoseconds;

namespace {

constexpr std::size_t kNoLimit = 1'000'000;

const std::vector<SignalInfo> kInfos = {{"a.x", "m", ValueType::Float64, true},
                                        {"a.on", "", ValueType::Boolean, false},
                                        {"a.label, long", "", ValueType::String, false}};
const std::string kHeader = "time,a.x [m],a.on,\"a.label, long\"\n";

struct Read {
  Signals signals;
  std::vector<std::string> notes;
};

Read read(const std::string& text, std::size_t limit = kNoLimit,
          std::span<const SignalInfo> infos = kInfos) {
  const TemporaryFolder folder;
  Notes notes(folder / "");
  Signals signals =
      read_signals(folder.write("signals.csv", text), infos, {.values = limit}, notes);
  return {std::move(signals), notes.texts()};
}

std::string refusal(const std::string& text) {
  return error_of([&] { read(kHeader + text); });
}

const std::vector<double>& doubles(const Column& column) {
  return std::get<std::vector<double>>(column.values());
}

}  // namespace

TEST_CASE("times are exact, and columns have the types in run.json") {
  const Signals signals =
      read(kHeader + "0,1.5,true,\"a\"\n0.000000000001,2,false,\"b, c\"\n30,3,false,\"\"\n")
          .signals;
  CHECK(signals.times == at_picoseconds({0, 1, 30'000'000'000'000}));
  REQUIRE(signals.columns.size() == 3);
  CHECK(signals.columns[0].name() == "a.x");
  CHECK(signals.columns[0].unit() == "m");
  CHECK(doubles(signals.columns[0]) == std::vector<double>{1.5, 2, 3});
  CHECK(signals.columns[1].type() == ValueType::Boolean);
  CHECK(signals.columns[2].name() == "a.label, long");
  CHECK_FALSE(signals.thinned);
}

TEST_CASE("columns without a type in run.json get it from their values") {
  const Signals signals = read("time,a.x [m],new [m/s],b[1],on\n0,1,2,3,true\n").signals;
  REQUIRE(signals.columns.size() == 4);
  CHECK(signals.columns[1].name() == "new");
  CHECK(signals.columns[1].unit() == "m/s");
  CHECK(signals.columns[1].type() == ValueType::Float64);
  CHECK(signals.columns[2].name() == "b[1]");
  CHECK(signals.columns[3].type() == ValueType::Boolean);
}

TEST_CASE("of several rows at one instant the last one counts") {
  const Signals signals = read(kHeader + "0,1,true,\"\"\n0,2,true,\"\"\n1,3,true,\"\"\n").signals;
  CHECK(signals.times == at_picoseconds({0, 1'000'000'000'000}));
  CHECK(doubles(signals.columns[0]) == std::vector<double>{2, 3});
}

TEST_CASE("a line that was cut off is reported, and the others are read") {
  const Read found = read(kHeader + "0,1,true,\"\"\n0.5,2,tr");
  CHECK(found.signals.times.size() == 1);
  REQUIRE(found.notes.size() == 1);
  CHECK_THAT(found.notes[0], Contains("signals.csv:3: the last line was cut off"));
}

TEST_CASE("a file that was cut off in its header, or before, is empty") {
  CHECK(read("").signals.columns.empty());
  const Read found = read("time,a.x");
  CHECK(found.signals.columns.empty());
  CHECK(found.notes.size() == 1);
}

TEST_CASE("a mistake is named with file, line and column") {
  CHECK_THAT(refusal("0,x,true,\"\"\n"),
             Contains("signals.csv:2: column 'a.x [m]': expected a number (the type is Float64), "
                      "found 'x'"));
  CHECK_THAT(refusal("0,1,true,\"\"\n1,1,yes,\"\"\n"),
             Contains("signals.csv:3: column 'a.on': expected true or false"));
  CHECK_THAT(refusal("0,1,true\n"),
             Contains("signals.csv:2: expected 4 fields, as in the header, found 3"));
  CHECK_THAT(refusal("soon,1,true,\"\"\n"), Contains("column 'time': 'soon' is not a number"));
  CHECK_THAT(refusal("1,1,true,\"\"\n0.5,1,true,\"\"\n"),
             Contains("signals.csv:3: column 'time': the time goes back"));
  CHECK_THAT(error_of([] { read("x,y\n1,2\n"); }), Contains("expected the column 'time'"));
  const std::string other = error_of([] { read(std::string(5000, 'x') + "\n"); });
  CHECK_THAT(other, Contains("xxx…': expected the column 'time'"));
  CHECK(other.size() < 500);
}

TEST_CASE("too many values are thinned while they are read, and no extreme is lost") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const std::size_t count = 50'000;
  std::vector<double> all(count);
  std::string text = "time,a.x [m],a.flat [m]\n";
  for (std::size_t i = 0; i < count; ++i) {
    all[i] = normal(random);
    text += fmt::format("{},{},7\n", static_cast<double>(i) / 8, all[i]);
  }
  const Read found = read(text, 10'000);
  REQUIRE(found.signals.thinned);
  const std::size_t block = *found.signals.thinned;
  const std::vector<stride::Time>& times = found.signals.times;
  CHECK(2 * times.size() <= 10'000);
  CHECK(times.size() > 500);
  CHECK(std::is_sorted(times.begin(), times.end()));
  CHECK(times.back() == at(static_cast<double>(count - 1) / 8));
  const std::vector<double>& kept = doubles(found.signals.columns[0]);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    rows.push_back(static_cast<std::size_t>(8 * stride::to_seconds(times[i])));
    CHECK(kept[i] == all[rows.back()]);
  }
  for (std::size_t first = 0; first < count; first += block) {
    const std::size_t end = std::min(count, first + block);
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    const auto [least, most] =
        std::minmax_element(begin, all.begin() + static_cast<std::ptrdiff_t>(end));
    for (const auto extreme : {least, most}) {
      const auto row = static_cast<std::size_t>(extreme - all.begin());
      CHECK(std::binary_search(rows.begin(), rows.end(), row));
    }
  }
  REQUIRE(found.notes.size() == 1);
  CHECK_THAT(found.notes[0], Contains("too many values"));
}

TEST_CASE("of texts only those are kept whose rows are") {
  std::string text = "time,a.name\n";
  for (int i = 0; i < 20'000; ++i) text += fmt::format("{},\"name {}\"\n", i, i);
  const Read found = read(text, 1'000);
  REQUIRE(found.signals.thinned);
  const Texts& texts = std::get<Texts>(found.signals.columns[0].values());
  CHECK(texts.distinct().size() == found.signals.times.size());
  for (std::size_t row = 0; row < found.signals.times.size(); ++row) {
    CHECK(texts.distinct()[static_cast<std::size_t>(texts.indices()[row])] ==
          fmt::format("name {}", stride::to_seconds(found.signals.times[row])));
  }
}

TEST_CASE("columns above the limit are left out, and a note says how many") {
  const TemporaryFolder folder;
  Notes notes(folder / "");
  const Signals signals =
      read_signals(folder.write("signals.csv", kHeader + "0,1.5,true,\"a\"\n1,2,false,\"b\"\n"),
                   kInfos, {.columns = 1}, notes);
  REQUIRE(signals.columns.size() == 1);
  CHECK(doubles(signals.columns[0]) == std::vector<double>{1.5, 2});
  CHECK(signals.left_out == 2);
  REQUIRE(notes.texts().size() == 1);
  CHECK_THAT(notes.texts()[0], Contains("the first 1 signals are shown, 2 are left out"));
}
