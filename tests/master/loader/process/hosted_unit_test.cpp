// A unit in a process of its own behaves as one in this; see also tests/master/loader/fmu, whose
// tests of instances run in both ways.
#include "master/loader/process/hosted_unit.h"

#include <deque>
#include <optional>
#include <set>

#include "tests/master/engine/run/forwarding.h"
#include "tests/master/loader/process/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::ValueBlock;
using core::ValueType;

namespace {

/// Values for one step, with their own memory.
struct Parts {
  void add_input(const core::Variable& variable, ValueBlock values) {
    add(inputs_, variable, std::move(values));
  }
  void add_output(const core::Variable& variable) {
    add(outputs_, variable, ValueBlock(variable.type, variable.size));
  }
  core::StepValues values() const { return {inputs_, outputs_}; }
  const ValueBlock& output(std::size_t i) const { return *outputs_[i].block; }

 private:
  void add(std::vector<core::BoundValues>& side, const core::Variable& variable,
           ValueBlock values) {
    blocks_.push_back(std::move(values));
    side.emplace_back(std::span(&variable.reference, 1), blocks_.back());
  }

  std::deque<ValueBlock> blocks_;
  std::vector<core::BoundValues> inputs_, outputs_;
};

ValueBlock binary(core::Binary bytes) {
  ValueBlock block(ValueType::Binary, 1);
  block.binaries()[0] = std::move(bytes);
  return block;
}

core::Binary pattern(std::size_t size) {
  core::Binary bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 31 + i / 251);
  return bytes;
}

}  // namespace

TEST_CASE("a hosted unit leaves nothing behind") {
  const Scratch scratch;
  const Belongings before;
  {
    Fixture unit("types");
    unit.start();
    CHECK(children().size() == before.processes.size() + 1);
    unit->terminate();
  }
  CHECK(Belongings() == before);
  CHECK(left_folders(scratch).empty());
}

TEST_CASE("binary values of many MiB go in and out") {
  constexpr std::size_t kSizes[] = {1, 0, 65'535, 70'000, 20'000'000, 3};
  Fixture unit("types");
  unit->enter_initialization({}, std::nullopt);
  for (const std::size_t size : kSizes) {
    const ValueBlock sent = binary(pattern(size));
    unit.set("binary", sent);
    CHECK(unit.get("binary.echo") == sent);
  }
  unit->exit_initialization();
  unit->update_discrete_states();
  unit->enter_step_mode();
  Time time{};
  for (const std::size_t size : kSizes) {
    const ValueBlock sent = binary(pattern(size));
    Parts parts;
    parts.add_input(unit.variable("binary"), sent);
    parts.add_output(unit.variable("binary.echo"));
    unit->step({time, time + Duration(1000)}, parts.values());
    time += Duration(1000);
    CHECK(parts.output(0) == sent);
  }
}

TEST_CASE("steps at the same addresses with other references set and get the right values") {
  Fixture unit("types");
  unit.start();
  Time time{};
  // the same addresses each time, with what is different behind them; more kinds than are kept
  for (int round = 0; round < 3; ++round) {
    for (std::size_t count = 0; count < 20; ++count) {
      std::vector<core::ValueReference> references(count, unit.variable("float64").reference);
      ValueBlock inputs(ValueType::Float64, count);
      for (std::size_t i = 0; i < count; ++i) inputs.numbers<double>()[i] = round + double(i);
      ValueBlock output(ValueType::Float64, 1);
      const std::vector<core::BoundValues> in{{references, inputs}};
      const std::vector<core::BoundValues> out{
          {{&unit.variable("float64.echo").reference, 1}, output}};
      unit->step({time, time + Duration(1000)}, {in, out});
      time += Duration(1000);
      if (count > 0) CHECK(output.numbers<double>()[0] == round + double(count - 1));
    }
  }
}

TEST_CASE("a unit that allows one instance per process has one in each") {
  Fixture first("single");
  Fixture second("single");
  first.start();
  second.start();
  CHECK(children().size() == 2);
}

TEST_CASE("what cannot be loaded is the same error as in this process") {
  const Scratch scratch;
  const auto fmu = importer::Fmu::load(make_raw_fmu(scratch, "raw_with_missing_library"));
  const auto make = [&](auto&& how) { return input_error([&] { how(); }); };
  const importer::InstanceOptions options{.where = {"system.ssd", 3}};
  const Belongings before;
  CHECK(make([&] { isolation::instantiate(fmu, "u", options, {}); }) ==
        make([&] { fmu->instantiate("u", options); }));
  CHECK(Belongings() == before);
}

TEST_CASE("what a unit logs has reached the log when the call ends") {
  std::vector<std::vector<Fixture::Line>> logs;
  for (const bool is_hosted : {false, true}) {
    Fixture unit("stepper", is_hosted, {}, {.debug_logging = true});
    unit.start({{"logs", "true"}});
    for (int i = 0; i < 1000; ++i) {
      const std::size_t before = unit.log.size();
      unit.step(i, i + 1);
      CHECK(unit.log.size() > before);
    }
    logs.push_back(unit.log);
  }
  REQUIRE(logs[0].size() == logs[1].size());
  CHECK_FALSE(logs[0].empty());
  for (std::size_t i = 0; i < logs[0].size(); ++i) {
    CHECK(logs[0][i].text == logs[1][i].text);
    CHECK(logs[0][i].status == logs[1][i].status);
    CHECK(logs[0][i].category == logs[1][i].category);
  }
}

TEST_CASE("a failure while inputs are set within a step is thrown as it is") {
  Fixture unit("oscillator_mass", true, {}, {.intermediate_update = true});
  unit.start();
  struct Own {};
  inputs_within_step(*unit).set_input_update([](double) { throw Own(); });
  CHECK_THROWS_AS(unit.step(0, 0.1), Own);
  int calls = 0;
  inputs_within_step(*unit).set_input_update([&](double) {
    ++calls;
    unit.set("x_other", "3");
  });
  unit.step(0.1, 0.2);
  CHECK(calls > 0);
  CHECK(unit.number("x_other") == 3);
}

TEST_CASE("a hosted unit has the capabilities that it has in this process, and those of a host") {
  std::set<std::size_t> seen;
  for (const char* name : {"types", "idler", "resizable", "clocks", "oscillator_mass"}) {
    CAPTURE(name);
    Fixture hosted(name), here(name, false);
    auto numbers = capability_numbers(*here);
    seen.merge(std::set(numbers));
    numbers.erase(static_cast<std::size_t>(core::StepsInARow::kId));  // of what is called here
    numbers.insert(static_cast<std::size_t>(core::HostDiagnostics::kId));
    numbers.insert(static_cast<std::size_t>(core::ConcurrentSteps::kId));
    CHECK(capability_numbers(*hosted) == numbers);
    seen.merge(numbers);
  }
  CHECK(seen.size() == core::kCapabilities);
}
