#include "master/loader/fmu/instance/call_note.h"

#include <csignal>
#include <string>
#include <utility>
#include <vector>

#include "master/base/child_process/child.h"
#include "master/base/child_process/shared_memory.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using importer::CallNote;

TEST_CASE("a note holds a function and its time until the call is over") {
  CallNote note;
  CHECK(note.function().empty());
  note.write("fmi3DoStep", Time(3ms));
  CHECK(note.function() == "fmi3DoStep");
  CHECK(note.time() == Time(3ms));
  note.clear();
  CHECK(note.function().empty());
  CHECK(note.time() == Time(3ms));
}

TEST_CASE("a note holds the variable whose value is read, until the next call") {
  CallNote note;
  CHECK_FALSE(note.variable());
  note.write("fmi3GetString");
  note.write_variable(7);
  CHECK(note.variable() == 7U);
  note.write("fmi3GetString");
  CHECK_FALSE(note.variable());
  note.write_variable(8);
  note.clear();
  CHECK_FALSE(note.variable());
}

TEST_CASE("a note outlives the process that wrote it, and is cut off where it is too long") {
  const isolation::Shared<CallNote> note;
  isolation::run_in_child([&] {
    note->write(std::string(1000, 'x').c_str(), Time(-7ms));
    std::raise(SIGKILL);
    return std::string();
  });
  CHECK(note->function() == std::string(CallNote::kLongestName, 'x'));
  CHECK(note->time() == Time(-7ms));
}

TEST_CASE("each function of a unit is noted while it is called, with the simulated time") {
  const Scratch scratch;
  const auto fmu = importer::Fmu::load(make_raw_fmu(scratch, "raw"));
  CallNote note;
  std::vector<std::pair<std::string, Time>> seen;
  const auto unit = fmu->instantiate(
      "warning", {.log = [&](auto&&...) { seen.emplace_back(note.function(), note.time()); },
                  .call_note = &note});
  unit->enter_initialization(Time(5ms), std::nullopt);
  CHECK(note.time() == Time(5ms));
  unit->exit_initialization();
  unit->enter_step_mode();
  unit->step({Time(5ms), Time(6ms)});
  unit->step({Time(6ms), Time(7ms)});
  CHECK(seen ==
        std::vector{std::pair{std::string("fmi3DoStep"), Time(5ms)}, {"fmi3DoStep", Time(6ms)}});
  CHECK(note.function().empty());
}

TEST_CASE("a step is noted again after its input update has called other functions") {
  const auto fmu = importer::Fmu::load(test_fmu("oscillator_mass"));
  CallNote note;
  const auto unit = fmu->instantiate("mass", {.intermediate_update = true, .call_note = &note});
  const auto place = fmu->description()->find("x_other").value();
  const core::ValueReference input = fmu->description()->variables[place].reference;
  const core::ValueBlock value(core::ValueType::Float64, 1);
  std::vector<std::string> seen;
  inputs_within_step(*unit).set_input_update([&](double) {
    seen.emplace_back(note.function());
    unit->set({&input, 1}, value);
    CHECK(note.function().empty());
  });
  unit->enter_initialization({}, std::nullopt);
  unit->exit_initialization();
  unit->update_discrete_states();
  unit->enter_step_mode();
  unit->step({{}, Time(100ms)});
  CHECK(seen.size() > 1);
  CHECK(seen == std::vector<std::string>(seen.size(), "fmi3DoStep"));
  CHECK(note.function().empty());
}
