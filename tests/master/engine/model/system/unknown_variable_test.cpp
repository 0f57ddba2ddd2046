#include "master/engine/model/system/unknown_variable.h"

#include <string>
#include <utility>

#include <catch2/catch.hpp>

#include "tests/error_of.h"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using stride::core::Causality;
using stride::core::Context;
using stride::core::Error;
using stride::core::UnitDescription;
using stride::core::Variable;

std::string hint_for(const std::string& name) {
  UnitDescription arm;
  arm.model_name = "arm";
  for (const char* known : {"time", "joint.base.start", "joint.base.position", "joint.elbow.start",
                            "actuator.elbow", "body.box.start"}) {
    Variable variable;
    variable.name = known;
    variable.causality = Causality::Parameter;
    arm.variables.push_back(variable);
  }
  Context context;
  context.unit = "world";
  context.variable = name;
  try {
    stride::core::fail_unknown_variable(context, arm);
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a variable that is not there is followed by the name that was meant") {
  CHECK_THAT(hint_for("joint.elbo.start"), EndsWith("did you mean 'joint.elbow.start'?"));
}

TEST_CASE("where no name is near, by those that begin and end alike") {
  CHECK_THAT(hint_for("joint.gripper_finger.start"),
             EndsWith("known are: joint.base.start, joint.elbow.start"));
}

TEST_CASE("where there are none, by all") {
  CHECK_THAT(hint_for("gripper.finger.width"),
             Contains("known are: time, joint.base.start, joint.base.position"));
  CHECK_THAT(hint_for("something"), Contains("known are: time, joint.base.start"));
}

TEST_CASE("a full name with a misspelt component is followed by the one that was meant") {
  CHECK_THAT(hint_for("wrold.time"), EndsWith("did you mean 'world.time'?"));
}

TEST_CASE("where no connector is expected, what can be set is listed") {
  UnitDescription unit;
  for (const auto& [name, causality] : {std::pair{"level", Causality::Output},
                                        {"rate", Causality::Local},
                                        {"inflow", Causality::Input},
                                        {"area", Causality::Parameter}}) {
    unit.variables.emplace_back().name = name;
    unit.variables.back().causality = causality;
  }
  Context context;
  context.variable = "something_else";
  CHECK_THAT(stride::tests::error_of([&] { stride::core::fail_unknown_variable(context, unit); }),
             EndsWith("known are: inflow, area"));
}
