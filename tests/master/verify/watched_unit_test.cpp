#include "master/verify/watched_unit.h"

#include <array>
#include <set>

#include "tests/master/algorithm/forwarding.h"
#include "tests/master/importer/support.h"

using namespace stride;
using namespace stride::tests;
using namespace stride::verify;
using namespace std::chrono_literals;

namespace {

/// A unit that is watched.
struct Watched {
  explicit Watched(const std::string& name)
      : tested(VerifyRequest{.file = test_fmu(name)}), unit(tested, note, name, {}) {}

  std::uint64_t calls() { return diagnostics(unit).calls(); }
  void start() {
    unit.enter_initialization({}, std::nullopt);
    unit.exit_initialization();
    unit.update_discrete_states();
    unit.enter_step_mode();
  }
  const core::Variable& variable(const std::string& name) const {
    const core::UnitDescription& description = tested.description();
    return description.variables.at(description.find(name).value());
  }

  TestedUnit tested;
  isolation::SharedNote note;
  WatchedUnit unit;
};

}  // namespace

TEST_CASE("a watched unit has all capabilities of the unit") {
  std::set<std::size_t> seen;
  for (const char* name : {"types", "idler", "resizable", "clocks", "oscillator_mass"}) {
    CAPTURE(name);
    Watched watched(name);
    const auto unit = watched.tested.fmu().instantiate("alone");
    CHECK(capability_numbers(watched.unit) == capability_numbers(*unit));
    seen.merge(capability_numbers(*unit));
  }
  // all but that of a unit in a process of its own
  CHECK(seen.size() == core::kCapabilities - 1);
}

TEST_CASE("each function of a watched unit is called, and no call is noted any longer") {
  Watched types("types");
  CHECK(types.calls() == 1);
  types.start();
  CHECK(types.calls() == 5);
  const core::ValueReference references[] = {types.variable("float64").reference};
  core::ValueBlock value(core::ValueType::Float64, 1);
  const std::array values{core::BoundValues(references, value)};
  types.unit.step({Time(), Time(1ms)}, {values, values});
  types.unit.step({Time(1ms), Time(2ms)});
  CHECK(types.calls() == 9);
  state(types.unit).save_state();
  const auto bytes = serialization(types.unit).serialize_state();
  serialization(types.unit).deserialize_state(bytes);
  state(types.unit).select_state(0);
  state(types.unit).restore_state();
  CHECK(types.calls() == 14);  // the bytes take two
  CHECK(texts(types.unit).describe_message(types.variable("receive.frame").reference, {0x26}) ==
        "1 bytes in receive.frame");
  types.unit.enter_event_mode();
  types.unit.terminate();
  resetting(types.unit).reset();
  CHECK(types.calls() == 18);
  CHECK(types.note.what().empty());
}

TEST_CASE("capabilities that are not watched are forwarded") {
  Watched idler("idler");
  idle(idler.unit).enable_idle_skipping(250ms);
  idler.start();
  CHECK(idle(idler.unit).idle_until() <= Time(250ms));
  CHECK(idler.calls() == 7);
}
