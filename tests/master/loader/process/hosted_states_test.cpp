// A hosted unit keeps and serialises its states as one in this process does: the same bytes, and
// each goes on from those of the other.
#include <csignal>
#include <set>

#include "tests/master/loader/process/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes serialized(Fixture& unit) {
  state(*unit).save_state();
  return serialization(*unit).serialize_state();
}

void restore(Fixture& unit, const Bytes& bytes) {
  serialization(*unit).deserialize_state(bytes);
  state(*unit).restore_state();
}

/// Steps with an input and an event now and then, from a number of ms to another; what was seen.
std::vector<Bytes> go_on(Fixture& unit, int from, int to) {
  std::vector<Bytes> seen;
  for (int i = from; i < to; ++i) {
    if (i % 5 == 0) {
      unit->enter_event_mode();
      unit.set("binary", "aa" + std::string(static_cast<std::size_t>(2 * (i % 3)), 'b'));
      unit->update_discrete_states();
      unit->enter_step_mode();
    }
    unit.set("float64", std::to_string(0.1 * i));
    unit.step(1e-3 * i, 1e-3 * (i + 1));
    seen.push_back(serialized(unit));
  }
  return seen;
}

}  // namespace

TEST_CASE("states are the same bytes in a host and in this process, and go on in either") {
  Fixture whole("types", false);
  whole.start();
  const std::vector<Bytes> expected = go_on(whole, 0, 20);
  REQUIRE(std::set<Bytes>(expected.begin(), expected.end()).size() == expected.size());
  for (const bool first_is_hosted : {false, true}) {
    Fixture first("types", first_is_hosted);
    first.start();
    std::vector<Bytes> seen = go_on(first, 0, 9);
    Fixture second("types", !first_is_hosted);  // never initialised
    restore(second, seen.back());
    CHECK(serialized(second) == seen.back());
    for (Bytes& bytes : go_on(second, 9, 20)) seen.push_back(std::move(bytes));
    CHECK(seen == expected);
  }
}

TEST_CASE("each slot of a hosted unit is serialised by itself") {
  Fixture unit("stepper");
  unit.start();
  std::vector<Bytes> bytes;
  for (std::size_t slot = 0; slot < 3; ++slot) {
    unit.step(double(slot), double(slot) + 1);
    state(*unit).select_state(slot);
    state(*unit).save_state();
    bytes.push_back(serialization(*unit).serialize_state());
  }
  for (std::size_t slot = 0; slot < 3; ++slot) {
    state(*unit).select_state(slot);
    CHECK(serialization(*unit).serialize_state() == bytes[slot]);
  }
  state(*unit).select_state(7);
  CHECK_THAT(run_error([&] { serialization(*unit).serialize_state(); }),
             Contains("no state of it has been saved"));
}

TEST_CASE("a state of many MiB goes through") {
  Fixture unit("types");
  unit.start();
  unit->enter_event_mode();
  core::ValueBlock block(core::ValueType::Binary, 1);
  block.binaries()[0] = core::Binary(9'000'000, 0x5A);
  unit.set("binary", block);
  unit->update_discrete_states();
  unit->enter_step_mode();
  const Bytes bytes = serialized(unit);
  CHECK(bytes.size() > 9'000'000);
  Fixture other("types");
  restore(other, bytes);
  CHECK(other.get("binary") == block);
  CHECK(serialized(other) == bytes);
}

TEST_CASE("a damaged state is the same error in a host and in this process") {
  std::vector<std::string> errors;
  for (const bool is_hosted : {false, true}) {
    Fixture source("types", is_hosted);
    source.start();
    Bytes bytes = serialized(source);
    bytes[bytes.size() / 2] ^= 4;
    Fixture unit("types", is_hosted);
    errors.push_back(run_error([&] { restore(unit, bytes); }));
  }
  CHECK_THAT(errors[0], Contains("fmi3DeserializeFMUState returned fmi3Error") &&
                            Contains("not a saved state of this unit"));
  CHECK(errors[1] == errors[0]);
}

TEST_CASE("a snapshot of the process is a state that is kept, but not one that is bytes") {
  Fixture unit("rejecter_without_state", true, {.takes_snapshots = true});
  CHECK(unit->capability<core::StateSaving>() != nullptr);
  CHECK(unit->capability<core::StateSerialization>() == nullptr);
}

TEST_CASE("after a restore the end of the process has the time of the state") {
  Fixture unit("stepper");
  unit.start();
  unit.step(0, 0.25);
  state(*unit).save_state();
  unit.step(0.25, 0.5);
  state(*unit).restore_state();
  REQUIRE(::kill(Fixture::server(), SIGKILL) == 0);
  CHECK_THAT(run_error([&] { unit.number("position"); }), Contains("at 0.25 s"));
}
