// A linear program: however a time is split into steps, the values at its end are the same.
#include <filesystem>
#include <fstream>
#include <random>

#include <catch2/catch.hpp>

#include "tests/units/process/program.h"
#include "units/process/model.h"

using namespace process;
using stride::Duration;
using stride::Time;

namespace {

// so that all sums are exact: fractions of two of a second, of which each is a whole number of
// picoseconds
constexpr std::int64_t kTick = 976'562'500;  // 2^-10 s
constexpr std::int64_t kTicks = 1000;

Declaration cistern() {
  const std::filesystem::path folder = stride::tests::cistern_program().parent_path();
  const std::filesystem::path copy = folder / "split";
  std::filesystem::create_directories(copy);
  std::filesystem::copy_file(folder / "cistern.xml", copy / "process.xml",
                             std::filesystem::copy_options::overwrite_existing);
  return load_declaration(copy);
}

std::size_t place(const Declaration& declaration, const std::string& name) {
  std::size_t i = 0;
  while (declaration.variables.at(i).name != name) ++i;
  return i;
}

struct End {
  double volume;
  std::vector<std::pair<Time, std::string>> messages;
};

/// From 0 to the end, in steps that end at these ticks; a step that stops early is gone on with.
End run(const Declaration& declaration, const std::vector<std::int64_t>& ends, bool may_stop) {
  std::vector<Value> values;
  for (const Variable& variable : declaration.variables) values.push_back(variable.start);
  values[place(declaration, "capacity")] = 0.25;
  values[place(declaration, "report_period")] = 0.0625;
  values[place(declaration, "inflow")] = 0.375;
  End end{};
  Session session(declaration, values, {stride::tests::cistern_program()}, {},
                  [](bool, const std::string&) {});
  Sync sync = session.start({"it", "", "", ""}, Time{});
  for (const std::int64_t tick : ends) {
    const Time to{Duration(tick * kTick)};
    do {
      sync = session.step(to, may_stop);
    } while (sync.time < to);
  }
  for (const Message& message : session.sent()) {
    end.messages.emplace_back(message.time, std::get<std::string>(message.value));
  }
  end.volume = std::get<double>(values[place(declaration, "volume")]);
  session.finish();
  return end;
}

}  // namespace

TEST_CASE("any split of a time leads to the same volume, and to the same messages") {
  const Declaration declaration = cistern();
  const bool may_stop = GENERATE(true, false);
  const End whole = run(declaration, {kTicks}, may_stop);
  CHECK(whole.volume == 0.25);
  CHECK(whole.messages.size() == 16);  // 15 reports and an alarm
  std::mt19937 random(4);
  for (int i = 0; i < 30; ++i) {
    std::vector<std::int64_t> ends;
    for (std::int64_t tick = 0; tick < kTicks;) {
      tick = std::min<std::int64_t>(tick + 1 + static_cast<std::int64_t>(random() % 200), kTicks);
      ends.push_back(tick);
    }
    const End split = run(declaration, ends, may_stop);
    CHECK(split.volume == whole.volume);
    CHECK(split.messages == whole.messages);
  }
}
