// A unit is what the other was, whatever it had been called with.
#include "master/observe/checkpoint/journaled_unit.h"

#include <algorithm>
#include <map>

#include <catch2/catch.hpp>

#include "tests/at.h"
#include "tests/error_of.h"
#include "tests/master/engine/run/forwarding.h"
#include "tests/master/observe/checkpoint/rig.h"
#include "tests/master/observe/checkpoint/sponge.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// A run of a sponge, and what it has written.
struct SpongeRun {
  explicit SpongeRun(const SpongeTraits& sponge_traits, unsigned seed = 1, Sponge::Log* log = {})
      : traits(sponge_traits), driver(Sponge::description(), seed) {
    auto unit = std::make_unique<Sponge>(traits, log);
    sponge = unit.get();
    rig.emplace(std::move(unit), Sponge::description(), false);
  }
  void start_and_advance(int steps) {
    driver.start(**rig);
    driver.advance(**rig, steps);
  }
  /// Another process goes on with what this one has written now.
  std::unique_ptr<SpongeRun> resumed(const std::vector<std::byte>& bytes,
                                     Sponge::Log* log = {}) const {
    auto other = std::make_unique<SpongeRun>(traits, 1, log);
    other->driver = driver;
    other->driver.connect(**other->rig);
    other->rig->read(bytes);
    return other;
  }
  SpongeRun(const SpongeRun&) = delete;
  SpongeRun& operator=(const SpongeRun&) = delete;

  SpongeTraits traits;
  Driver driver;
  Sponge* sponge = nullptr;
  std::optional<Rig> rig;
};

/// Both go on by the same calls, and answer the same.
void check_same_future(SpongeRun& run, SpongeRun& resumed, int steps = 20) {
  run.driver.advance(**run.rig, steps);
  resumed.driver.advance(**resumed.rig, steps);
  check_same(run.driver.got, resumed.driver.got);
}

const std::map<std::string, SpongeTraits> kKinds = {
    {"without state", {.saves = false}},
    {"without state, concurrent", {.saves = false, .is_concurrent = true}},
    {"with rollbacks", {.rejects = true}},
    {"with rollbacks, concurrent", {.rejects = true, .is_concurrent = true}},
    {"with inputs within steps", {.asks_for_inputs = true, .rejects = true}},
    {"with inputs within concurrent steps",
     {.asks_for_inputs = true, .rejects = true, .is_concurrent = true}},
    {"that rejects for ever", {.saves = false, .rejects = true}},
    {"serialised", {.serializes = true, .asks_for_inputs = true, .rejects = true}},
    {"serialised, concurrent", {.serializes = true, .rejects = true, .is_concurrent = true}},
    {"with one slot", {.serializes = true, .has_one_slot = true}},
    {"that cannot be serialised", {.serializes = true, .fails_to_serialize = true}},
    {"serialised sometimes",
     {.serializes = true, .serializes_sometimes = true, .asks_for_inputs = true, .rejects = true}},
};

}  // namespace

TEST_CASE("a unit that is read goes on as the one that was written") {
  for (const auto& [name, traits] : kKinds) {
    CAPTURE(name);
    for (unsigned seed = 1; seed <= 40; ++seed) {
      CAPTURE(seed);
      SpongeRun run(traits, seed);
      run.start_and_advance(static_cast<int>(seed % 30));
      run.sponge->wake(seed % 2 == 0);
      const std::vector<std::byte> bytes = run.rig->write();
      check_same_future(run, *run.resumed(bytes));
    }
  }
}

TEST_CASE("to write it changes nothing of the unit") {
  for (const auto& [name, traits] : kKinds) {
    CAPTURE(name);
    SpongeRun run(traits), other(traits);
    run.start_and_advance(0);
    other.start_and_advance(0);
    for (int i = 0; i < 50; ++i) {
      run.rig->write();
      run.driver.advance(**run.rig, 1);
      other.driver.advance(**other.rig, 1);
    }
    check_same(run.driver.got, other.driver.got);
  }
}

TEST_CASE("a unit that was read can be written again, and read again") {
  for (const auto& [name, traits] : kKinds) {
    CAPTURE(name);
    SpongeRun run(traits, 3);
    run.start_and_advance(5);
    std::vector<std::unique_ptr<SpongeRun>> generations;
    generations.push_back(run.resumed(run.rig->write()));
    for (int i = 0; i < 6; ++i) {
      SpongeRun& last = *generations.back();
      last.sponge->wake(i % 3 != 0);
      last.driver.advance(**last.rig, 7);
      generations.push_back(last.resumed(last.rig->write()));
    }
    run.driver.advance(**run.rig, 6 * 7);
    check_same(generations.back()->driver.got, run.driver.got);
    check_same_future(run, *generations.back());
  }
}

TEST_CASE("a state that was saved before a checkpoint can be restored behind it") {
  for (const bool is_awake : {true, false}) {
    CAPTURE(is_awake);
    SpongeRun run({.serializes = true, .serializes_sometimes = true});
    run.driver.goes_back = false;
    run.start_and_advance(5);
    state(**run.rig).save_state();
    Driver before = run.driver;
    before.connect(**run.rig);
    run.driver.advance(**run.rig, 3);
    run.rig->write();
    run.driver.advance(**run.rig, 3);
    run.sponge->wake(is_awake);
    run.rig->write();
    run.driver.advance(**run.rig, 3);
    state(**run.rig).restore_state();
    run.driver = before;
    const auto bytes = run.rig->write();
    check_same_future(run, *run.resumed(bytes));
    CHECK(run.rig->journaled->kept().repeated_steps == (is_awake ? 5 : 0));
  }
}

TEST_CASE("a unit serialises its state, or its calls are repeated") {
  const auto kept = [](const SpongeTraits& traits, bool is_awake) {
    SpongeRun run(traits);
    run.driver.goes_back = false;
    run.start_and_advance(7);
    run.sponge->wake(is_awake);
    run.rig->write();
    return to_text(run.rig->journaled->kept());
  };
  CHECK(kept({.saves = false}, false) == "replayed: 7 steps since 0 s");
  CHECK(kept({}, false) == "replayed: 7 steps since 0 s");
  CHECK(kept({.serializes = true}, false) == "serialised, 8 B");
  CHECK(kept({.serializes = true, .serializes_sometimes = true}, true) ==
        "serialised at 0 s, 8 B, then replayed: 7 steps");
  CHECK(kept({.serializes = true, .serializes_sometimes = true}, false) == "serialised, 8 B");
}

TEST_CASE("a unit that cannot be serialised, though it says so, is warned of once") {
  SpongeRun run({.serializes = true, .fails_to_serialize = true});
  run.start_and_advance(3);
  run.rig->write();
  REQUIRE(run.rig->warnings->size() == 1);
  CHECK_THAT(run.rig->warnings->front(),
             StartsWith("its state cannot be serialised, though it declares that it can") &&
                 Contains("it cannot be serialised now"));
  CHECK(to_text(run.rig->journaled->kept()) == "replayed: 3 steps since 0 s");
}

TEST_CASE("what a unit logged is not logged again") {
  SpongeRun run({.saves = false});
  run.start_and_advance(4);
  Sponge::Log log;
  const auto resumed = run.resumed(run.rig->write(), &log);
  CHECK(log.empty());
  resumed->driver.advance(**resumed->rig, 2);
  CHECK(log.size() == 2);
}

TEST_CASE("a unit that does not repeat itself is an error with its name and the time") {
  const auto error = [](const SpongeTraits& traits) {
    SpongeRun run(traits);
    run.driver.goes_back = false;
    run.start_and_advance(1);
    while (run.driver.time() < at(1.5)) run.driver.advance(**run.rig, 1);
    const auto bytes = run.rig->write();
    return error_of([&] { run.resumed(bytes); });
  };
  CHECK_THAT(error({.saves = false, .is_random = true}),
             StartsWith("system.ssd:7: unit 'part', at 0.00") &&
                 Contains("it cannot be resumed: its calls were repeated") &&
                 Contains("let it serialise its state (canSerializeFMUState)"));
  CHECK_THAT(error({.saves = false, .is_random_late = true}),
             StartsWith("system.ssd:7: unit 'part', at 1.00") ||
                 StartsWith("system.ssd:7: unit 'part', at 0.99"));  // where the step began
  CHECK_THAT(
      error({.saves = false, .fails_when_repeated = true}),
      StartsWith("unit 'sponge', at 0 s") &&
          Contains("what it did before was repeated, to resume it, and failed: it is tired"));
  CHECK(error({.saves = false}) == "(no error)");
}

TEST_CASE("a unit whose outputs are others behind its restored state is an error") {
  SpongeRun run({.serializes = true, .does_not_restore = true});
  run.driver.goes_back = false;
  run.start_and_advance(1);
  const auto first = run.rig->write();
  CHECK(error_of([&] { run.resumed(first); }) != "(no error)");
  while (run.driver.time() < at(0.5)) run.driver.advance(**run.rig, 1);
  const auto bytes = run.rig->write();
  CHECK_THAT(error_of([&] { run.resumed(bytes); }),
             StartsWith("system.ssd:7: unit 'part', variable 'y', at 0.5") &&
                 Contains("its state was restored, and this output is not what it was"));
}

TEST_CASE("a run that goes on for longer gives its units the new stop time") {
  core::Describe describe("device");
  const auto description = describe.input("u").done();
  std::optional<Time> stop;
  class Device final : public core::ForwardingUnit {
   public:
    Device(std::optional<Time>& stop)
        : ForwardingUnit(std::make_unique<PlainUnit>()), stop_(stop) {}
    void enter_initialization(Time, std::optional<Time> stop) override { stop_ = stop; }

   private:
    std::optional<Time>& stop_;
  };
  Rig rig(std::make_unique<Device>(stop), description);
  rig->enter_initialization({}, at(10));
  rig->exit_initialization();
  const auto bytes = rig.write();
  Rig(std::make_unique<Device>(stop), description).read(bytes);
  CHECK(stop == at(10));
  Rig(std::make_unique<Device>(stop), description, true, at(20)).read(bytes);
  CHECK(stop == at(20));
}

TEST_CASE("a unit is written at a communication point, and read before it is called") {
  SpongeRun run({.is_concurrent = true});
  CHECK_THAT(error_of([&] { run.rig->write(); }), Contains("it is not in Step Mode"));
  run.start_and_advance(2);
  const auto bytes = run.rig->write();
  CHECK_THROWS_AS(run.rig->read(bytes), std::logic_error);
  auto& concurrent = (*run.rig)->require_capability<core::ConcurrentSteps>();
  concurrent.begin_step({run.driver.time(), run.driver.time() + Duration(1)}, {}, {});
  CHECK_THAT(error_of([&] { run.rig->write(); }), Contains("it is not in Step Mode"));
  concurrent.finish_step();
  CHECK(error_of([&] { run.rig->write(); }) == "(no error)");
}

TEST_CASE("damaged bytes are refused before the unit is called") {
  for (const auto& traits :
       {SpongeTraits{.serializes = true, .serializes_sometimes = true}, SpongeTraits{}}) {
    SpongeRun run(traits);
    run.start_and_advance(3);
    run.sponge->wake(true);
    const std::vector<std::byte> bytes = run.rig->write();
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      std::vector<std::byte> damaged = bytes;
      damaged[i] ^= std::byte{0x10};
      SpongeRun other(traits);
      CHECK_THROWS_AS(other.rig->read(damaged), core::BadState);
      CHECK(other.sponge->calls() == 0);
      damaged = bytes;
      damaged.resize(i);
      SpongeRun another(traits);
      CHECK_THROWS_AS(another.rig->read(damaged), core::BadState);
    }
  }
}

TEST_CASE("a state of a unit that serialises is not for one that does not") {
  SpongeRun run({.serializes = true});
  run.start_and_advance(2);
  const auto bytes = run.rig->write();
  SpongeRun other(SpongeTraits{});
  CHECK_THROWS_AS(other.rig->read(bytes), core::BadState);
}

TEST_CASE("a journaled unit forwards all functions, and has the capabilities of its unit") {
  CompleteUnit::Calls calls;
  const auto description = core::Describe("complete").event_mode().done();
  checkpoint::JournaledUnit unit(std::make_unique<CompleteUnit>(calls), *description, {});
  check_capabilities(unit, {core::CapabilityId::StateSerialization, core::CapabilityId::Resetting});
  check_state_saving(unit, calls);
  check_idle_promises(unit, calls);
  check_functions(unit, calls);
  CHECK_THROWS_AS(state(unit).select_state(1), std::logic_error);
  core::Unit& plain =
      *new checkpoint::JournaledUnit(std::make_unique<PlainUnit>(), *description, {});
  const std::unique_ptr<core::Unit> owner(&plain);
  CHECK(capability_numbers(plain).empty());
}
