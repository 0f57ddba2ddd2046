#include "master/engine/run/stepping/step_order.h"

#include <catch2/catch.hpp>

#include "tests/master/engine/run/scripted_unit.h"

using namespace stride::core;
using Catch::Matchers::Contains;

namespace {

System system_of(std::vector<Describe> units) {
  SystemDeclaration declaration;
  for (std::size_t i = 0; i < units.size(); ++i) {
    declaration.components.push_back(
        {std::string(1, static_cast<char>('a' + i)), units[i].done(), {}, {}});
  }
  return System(declaration);
}

std::string names(const System& system) {
  std::string text;
  for (const StepOrderEntry& entry : step_order(system, kFixedSteps, Coupling::Jacobi))
    text += system.components()[entry.component].name;
  return text;
}

Describe obedient() { return Describe("obedient").never_rejects(); }
Describe unknown() { return Describe("unknown"); }
Describe rollback() { return Describe("rollback").can_save_state(); }
Describe follower() { return Describe("follower").never_rejects().can_save_state(); }
Describe early() { return Describe("early").never_rejects().may_return_early(); }

}  // namespace

TEST_CASE("order: units with rollback, then the unit that may stop, then the followers") {
  CHECK(names(system_of({obedient(), early(), rollback(), unknown(), rollback()})) == "cebda");
}

TEST_CASE("within a role the order is that of the file") {
  CHECK(names(system_of({rollback(), rollback(), rollback()})) == "abc");
  CHECK(names(system_of({obedient(), obedient(), obedient()})) == "abc");
}

TEST_CASE("a unit that never stops follows, and is rolled back only where errors are controlled") {
  const System system = system_of({follower(), early(), rollback()});
  CHECK(names(system) == "cba");
  const System pair = system_of({follower(), rollback()});
  const auto order = step_order(pair, kErrorControlledSteps, Coupling::Jacobi);
  CHECK(order[0].component == 0);
  CHECK((order[0].saves_state && order[1].saves_state));
}

TEST_CASE("a unit that cannot be rolled back begins a new stage where one before it may stop") {
  const auto stages = [](std::vector<Describe> units) {
    std::string text;
    const System system = system_of(std::move(units));
    for (const StepOrderEntry& entry : step_order(system, kFixedSteps, Coupling::Jacobi)) {
      text += std::to_string(entry.stage);
    }
    return text;
  };
  CHECK(stages({rollback(), rollback().may_return_early(), rollback()}) == "000");
  CHECK(stages({rollback(), rollback().may_return_early(), obedient(), obedient()}) == "0011");
  CHECK(stages({rollback(), early(), obedient()}) == "012");
  CHECK(stages({follower(), early(), obedient()}) == "011");
  CHECK(stages({rollback(), rollback().may_return_early(), early(), obedient()}) == "0012");
  CHECK(stages({follower(), follower(), obedient(), obedient()}) == "0000");
  CHECK(stages({rollback(), rollback(), follower(), follower()}) == "0011");
  CHECK(stages({unknown(), unknown(), obedient(), obedient()}) == "0122");
}

TEST_CASE("a state is saved only where another unit may stop") {
  const auto saves = [](std::vector<Describe> units) {
    std::string text;
    for (const StepOrderEntry& entry :
         step_order(system_of(std::move(units)), kFixedSteps, Coupling::Jacobi)) {
      text += entry.saves_state ? 's' : '-';
    }
    return text;
  };
  CHECK(saves({follower(), follower(), obedient()}) == "---");
  CHECK(saves({follower(), follower(), early()}) == "---");
  CHECK(saves({rollback(), follower(), obedient()}) == "---");
  CHECK(saves({rollback(), rollback(), early()}) == "ss-");
  CHECK(saves({rollback(), rollback(), unknown()}) == "ss-");
  CHECK(saves({rollback().may_return_early(), rollback().may_return_early()}) == "ss");
}

TEST_CASE("a snapshot is as good as a state") {
  CHECK_FALSE(system_of({early()}).components()[0].can_save_state());
  CHECK(system_of({rollback()}).components()[0].can_save_state());
  SystemDeclaration declaration;
  declaration.components.push_back({"a", early().done(), {}, {}, true, true});
  CHECK(System(declaration).components()[0].can_save_state());
}

namespace {

/// A unit, and whether its process can be saved.
struct Hosted {
  Describe unit;
  bool has_snapshots = false;
};

SystemDeclaration declare(const std::vector<Hosted>& units) {
  SystemDeclaration declaration;
  for (const Hosted& hosted : units) {
    const std::string name(1, static_cast<char>('a' + declaration.components.size()));
    declaration.components.push_back(
        {name, hosted.unit.done(), {}, {}, true, hosted.has_snapshots});
  }
  return declaration;
}

/// The step order, with a star behind each name whose state is saved, and a bar between stages.
std::string order_of(const std::vector<Hosted>& units, const StepPolicyType& policy = kFixedSteps) {
  const System system(declare(units));
  std::string text;
  std::size_t stage = 0;
  for (const StepOrderEntry& entry : step_order(system, policy, Coupling::Jacobi)) {
    if (entry.stage != stage) text += '|';
    stage = entry.stage;
    text += system.components()[entry.component].name + (entry.saves_state ? "*" : "");
  }
  return text;
}

std::string reason_of(const std::vector<Hosted>& units, std::size_t component) {
  for (const StepOrderEntry& entry :
       step_order(System(declare(units)), kFixedSteps, Coupling::Jacobi)) {
    if (entry.component == component) return entry.reason;
  }
  return "";
}

constexpr bool kSnapshots = true;

}  // namespace

TEST_CASE("of those that may return early and have snapshots at most, one needs none") {
  CHECK(order_of({{early(), kSnapshots}, {obedient()}}) == "a|b");
  CHECK(order_of({{early(), kSnapshots}, {rollback()}}) == "b*|a");
  CHECK(order_of({{early(), kSnapshots}, {early(), kSnapshots}}) == "b*|a");
  CHECK(order_of({{early(), kSnapshots}, {early()}, {early(), kSnapshots}}) == "a*c*|b");
  CHECK(order_of({{obedient(), kSnapshots}, {early(), kSnapshots}, {early(), kSnapshots}}) ==
        "c*|b|a");
}

TEST_CASE("a unit that may only reject a step is saved where another may stop") {
  CHECK(order_of({{unknown(), kSnapshots}, {obedient()}}) == "a|b");
  CHECK(order_of({{unknown(), kSnapshots}, {unknown(), kSnapshots}}) == "b*|a");
  CHECK(order_of({{unknown(), kSnapshots}, {unknown()}}) == "a*|b");
  CHECK(order_of({{unknown(), kSnapshots}, {early()}}) == "a*|b");
  CHECK(order_of({{unknown(), kSnapshots}, {early(), kSnapshots}}) == "a*|b");
  CHECK(order_of({{unknown()}, {early(), kSnapshots}}) == "b|a");
  CHECK(order_of({{unknown(), kSnapshots}, {rollback()}}) == "b*|a");
}

TEST_CASE("with error-controlled steps everybody is saved") {
  CHECK(order_of({{early(), kSnapshots}, {obedient(), kSnapshots}, {follower()}},
                 kErrorControlledSteps) == "a*b*c*");
}

TEST_CASE("a state of the unit is preferred to snapshots") {
  CHECK(order_of({{rollback().may_return_early(), kSnapshots}, {early()}}) == "a*|b");
  CHECK_THAT(reason_of({{rollback(), kSnapshots}, {early()}}, 0), Contains("its state is saved"));
}

TEST_CASE("the reason has which unit needs a snapshot and which does not") {
  const std::vector<Hosted> pair = {{early(), kSnapshots}, {early(), kSnapshots}};
  CHECK_THAT(reason_of(pair, 0), Contains("may return early") && Contains("no snapshot needed"));
  CHECK_THAT(reason_of(pair, 1), Contains("a snapshot of its process is taken before each step"));
  CHECK_THAT(reason_of({{unknown(), kSnapshots}, {obedient(), kSnapshots}}, 0),
             Contains("might reject a step") && Contains("no snapshot needed"));
  CHECK_THAT(reason_of({{unknown(), kSnapshots}, {obedient(), kSnapshots}}, 1),
             Contains("nothing is saved"));
}

TEST_CASE("the units that need snapshots") {
  using enum SnapshotProcess;
  const auto missing = [](const std::vector<Hosted>& units,
                          const std::array<SnapshotProcess, 3>& processes,
                          const StepPolicyType& policy = kFixedSteps) {
    std::string text;
    for (const std::size_t i : missing_snapshots(declare(units).components, policy, processes)) {
      text += static_cast<char>('a' + i);
    }
    return text;
  };
  const std::array all{New, New, New};
  CHECK(missing({{early()}, {rollback()}, {unknown()}}, all) == "");
  CHECK(missing({{early()}, {early()}, {unknown()}}, all) == "b");
  CHECK(missing({{early()}, {early()}, {early()}}, all) == "bc");
  CHECK(missing({{early()}, {early(), kSnapshots}, {early()}}, all) == "c");
  CHECK(missing({{early()}, {rollback().may_return_early()}, {early()}}, all) == "c");
  CHECK(missing({{early()}, {early()}, {obedient()}}, {New, None, New}) == "a");
  CHECK(missing({{early()}, {early()}, {early()}}, {New, None, None}) == "a");
  CHECK(missing({{early()}, {early()}, {early()}}, {Own, New, Own}) == "ac");
  CHECK(missing({{early()}, {early()}, {unknown()}}, {Own, Own, Own}) == "b");
  CHECK(missing({{early()}, {unknown()}, {unknown()}}, {Own, Own, Own}) == "");
  CHECK(missing({{early()}, {obedient()}, {follower()}}, all, kErrorControlledSteps) == "ab");
  CHECK(missing({{early()}, {obedient(), kSnapshots}, {unknown()}}, {New, New, None},
                kErrorControlledSteps) == "a");
}

TEST_CASE("a system with the missing snapshots has a step order") {
  std::vector<Hosted> units = {{early()}, {unknown()}, {early()}, {early()}, {obedient()}};
  using enum SnapshotProcess;
  const std::array processes{New, New, None, New, New};
  CHECK_THROWS_AS(order_of(units), Error);
  for (const std::size_t i : missing_snapshots(declare(units).components, kFixedSteps, processes)) {
    units[i].has_snapshots = true;
  }
  CHECK(order_of(units) == "a*d*|c|b|e");
}

TEST_CASE("a unit that is not allowed to return early needs no snapshots") {
  SystemDeclaration declaration = declare({{early()}, {early()}});
  declaration.components[1].early_return_allowed = false;
  CHECK(missing_snapshots(declaration.components, kFixedSteps,
                          std::array{SnapshotProcess::New, SnapshotProcess::New})
            .empty());
}

TEST_CASE("two units that stop early and cannot go back are refused by name") {
  try {
    order_of({{early()}, {rollback()}, {early()}, {early(), kSnapshots}});
    FAIL("accepted");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Input);
    CHECK_THAT(error.what(), Contains("'a' and 'c'"));
    CHECK_THAT(error.what(), Contains("<stride:EarlyReturn components=\"c\" allowed=\"false\"/>") &&
                                 Contains("<stride:Host components=\"c\" snapshots=\"true\"/>") &&
                                 Contains("canGetAndSetFMUState"));
  }
}

TEST_CASE("a unit that is not allowed to return early follows") {
  SystemDeclaration declaration;
  for (const char* name : {"a", "b", "c"}) {
    declaration.components.push_back({name, early().done(), {}, {}});
  }
  declaration.components[0].early_return_allowed = false;
  declaration.components[2].early_return_allowed = false;
  const auto order = step_order(System(declaration), kFixedSteps, Coupling::Jacobi);
  REQUIRE(order.size() == 3);
  CHECK(order[0].component == 1);
  CHECK(order[0].role == StepRole::MayReturnEarly);
  CHECK(order[1].role == StepRole::Follows);
  CHECK(order[1].stage == 1);
  CHECK_THAT(order[1].reason, Contains("is not allowed to return early"));
  CHECK(order[2].component == 2);
}
