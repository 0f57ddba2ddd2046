#include "master/core/step_order.h"

#include <catch2/catch.hpp>

#include "scripted_unit.h"

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
  for (const StepPlace& place : step_order(system, StepPolicy::Fixed, Coupling::Jacobi))
    text += system.components()[place.component].name;
  return text;
}

Describe obedient() { return Describe("obedient").never_rejects(); }
Describe unknown() { return Describe("unknown"); }
Describe rollback() { return Describe("rollback").can_save_state(); }
Describe follower() { return Describe("follower").never_rejects().can_save_state(); }
Describe early() { return Describe("early").never_rejects().may_return_early(); }

}  // namespace

TEST_CASE("first what can go back, then what stops on its own, then what does as it is told") {
  CHECK(names(system_of({obedient(), early(), rollback(), unknown(), rollback()})) == "cebda");
}

TEST_CASE("within a role the order is that of the file") {
  CHECK(names(system_of({rollback(), rollback(), rollback()})) == "abc");
  CHECK(names(system_of({obedient(), obedient(), obedient()})) == "abc");
}

TEST_CASE("who never stops follows, and is rolled back only where errors are controlled") {
  const System system = system_of({follower(), early(), rollback()});
  CHECK(names(system) == "cba");
  const System pair = system_of({follower(), rollback()});
  const auto order = step_order(pair, StepPolicy::ErrorControlled, Coupling::Jacobi);
  CHECK(order[0].component == 0);
  CHECK((order[0].saves_state && order[1].saves_state));
}

TEST_CASE("who cannot go back begins a new stage where one before it may stop") {
  const auto stages = [](std::vector<Describe> units) {
    std::string text;
    const System system = system_of(std::move(units));
    for (const StepPlace& place : step_order(system, StepPolicy::Fixed, Coupling::Jacobi)) {
      text += std::to_string(place.stage);
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
    for (const StepPlace& place :
         step_order(system_of(std::move(units)), StepPolicy::Fixed, Coupling::Jacobi)) {
      text += place.saves_state ? 's' : '-';
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

TEST_CASE("two units that stop early and cannot go back are refused by name") {
  try {
    step_order(system_of({early(), rollback(), early()}), StepPolicy::Fixed, Coupling::Jacobi);
    FAIL("accepted");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Input);
    CHECK_THAT(error.what(), Contains("'a' and 'c'"));
    CHECK_THAT(error.what(), Contains("<stride:EarlyReturn components=\"c\" allowed=\"false\"/>") &&
                                 Contains("canGetAndSetFMUState"));
  }
}

TEST_CASE("who is not allowed to return early does as it is told") {
  SystemDeclaration declaration;
  for (const char* name : {"a", "b", "c"}) {
    declaration.components.push_back({name, early().done(), {}, {}});
  }
  declaration.components[0].early_return_allowed = false;
  declaration.components[2].early_return_allowed = false;
  const auto order = step_order(System(declaration), StepPolicy::Fixed, Coupling::Jacobi);
  REQUIRE(order.size() == 3);
  CHECK(order[0].component == 1);
  CHECK(order[0].role == StepRole::MayStopEarly);
  CHECK(order[1].role == StepRole::DoesAsTold);
  CHECK(order[1].stage == 1);
  CHECK_THAT(order[1].reason, Contains("is not allowed to return early"));
  CHECK(order[2].component == 2);
}
