// The judge of measurements seen by an importer.
#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const UnitLibrary& library() {
  static const UnitLibrary only(unit_library("ground_truth"));
  return only;
}

InstanceChoices choices() {
  InstanceChoices choices;
  choices.resources = STRIDE_SOURCE_DIR "/units/ground_truth/resources/";
  choices.logging = true;
  return choices;
}

/// A unit in Step Mode.
class GroundTruth {
 public:
  explicit GroundTruth(double tolerance = 0.5, double max_age = 0.0) : unit_(library(), choices()) {
    REQUIRE(unit_.set_real("tolerance", tolerance) == fmi3OK);
    REQUIRE(unit_.set_real("max_age", max_age) == fmi3OK);
    REQUIRE(unit_.start_steps() == fmi3OK);
  }
  UnitInstance& unit() { return unit_; }

  void step_to(double time) {
    const double now = unit_.real("time");
    REQUIRE(unit_.step(now, time - now) == fmi3OK);
    CHECK_FALSE(unit_.last.event);
  }
  void set_truth(double truth) { REQUIRE(unit_.set_real("truth", truth) == fmi3OK); }

  /// The status of the event in which a measurement comes.
  fmi3Status measure(double value, double age = 0.0, double resolution = 0.0) {
    REQUIRE(library().EnterEventMode(unit_.handle) == fmi3OK);
    REQUIRE(unit_.set_clock("measurement.clock", true) == fmi3OK);
    REQUIRE(unit_.set_real("measurement.value", value) == fmi3OK);
    REQUIRE(unit_.set_real("measurement.age", age) == fmi3OK);
    REQUIRE(unit_.set_real("measurement.age_resolution", resolution) == fmi3OK);
    const fmi3Status status = unit_.update();
    if (status == fmi3OK) REQUIRE(library().EnterStepMode(unit_.handle) == fmi3OK);
    return status;
  }

  std::uint64_t count(const std::string& name) {
    const fmi3ValueReference r = unit_.reference("measurements." + name);
    std::uint64_t count = 0;
    REQUIRE(library().GetUInt64(unit_.handle, &r, 1, &count, 1) == fmi3OK);
    return count;
  }
  bool passed() {
    const fmi3ValueReference r = unit_.reference("passed");
    bool passed = false;
    REQUIRE(library().GetBoolean(unit_.handle, &r, 1, &passed, 1) == fmi3OK);
    return passed;
  }
  std::string text() {
    const fmi3ValueReference r = unit_.reference("text");
    fmi3String text = nullptr;
    REQUIRE(library().GetString(unit_.handle, &r, 1, &text, 1) == fmi3OK);
    return text;
  }
  /// All that it says.
  std::string state() {
    std::string all = text() + (passed() ? " passed" : " failed");
    for (const char* name :
         {"last.error", "worst.error", "worst.time", "worst.measured", "worst.truth"}) {
      all += " " + std::to_string(unit_.real(name));
    }
    return all + " " + std::to_string(count("right")) + " " + std::to_string(count("wrong"));
  }

 private:
  UnitInstance unit_;
};

}  // namespace

TEST_CASE("the units of the variables come from the resources") {
  const std::string xml = library().describe(STRIDE_SOURCE_DIR "/units/ground_truth/resources/");
  CHECK(attribute(xml, "name=\"truth\"", "unit") == "degC");
  CHECK(attribute(xml, "name=\"measurement.value\"", "unit") == "degC");
  CHECK(attribute(xml, "name=\"tolerance\"", "unit") == "K");
  CHECK(attribute(xml, "name=\"worst.error\"", "unit") == "K");
  CHECK(attribute(xml, "<stride:Unit", "verdict") == "passed");
  CHECK(attribute(xml, "<stride:Unit", "verdictText") == "text");
  CHECK_THROWS_WITH(library().describe("/nowhere/"), Contains("quantity.xml: cannot be read"));
  CHECK_THROWS_WITH(library().describe(), Contains("no resources folder"));
}

TEST_CASE("a measurement counts once, also if it is the same as before") {
  GroundTruth judge;
  CHECK_FALSE(judge.passed());
  judge.set_truth(21.5);
  judge.step_to(1);
  CHECK(judge.measure(21.75) == fmi3OK);
  CHECK(judge.passed());
  judge.step_to(2);
  CHECK(judge.measure(21.75) == fmi3OK);
  CHECK(judge.count("right") == 2);
  CHECK(judge.unit().real("last.error") == 0.25);
  CHECK(judge.unit().real("worst.time") == 1);
  CHECK(judge.unit().messages.empty());
}

TEST_CASE("what is wrong is logged with the time, both values and the tolerance") {
  GroundTruth judge;
  judge.set_truth(21.5);
  judge.step_to(1.25);
  CHECK(judge.measure(25) == fmi3OK);
  CHECK_FALSE(judge.passed());
  CHECK(judge.count("wrong") == 1);
  CHECK_THAT(judge.unit().last_message(),
             Contains("measurement at 1.25 s: 25 degC is wrong, error 3.5 K, tolerance 0.5 K; the "
                      "nearest truth between 1.25 s and 1.25 s is 21.5 degC"));
  CHECK(judge.measure(25, 60) == fmi3OK);
  CHECK(judge.count("unknown") == 1);
  CHECK_THAT(judge.unit().last_message(), Contains("is not compared"));
  CHECK(judge.text() ==
        "0 of 1 measurement right; 1 too old to be checked; worst error 3.5 K at 1.25 s: 25 degC "
        "for 21.5 "
        "degC");
}

TEST_CASE("the truth of an instant is the one that the input has there") {
  GroundTruth judge;
  judge.set_truth(20);
  judge.step_to(1);
  judge.set_truth(30);  // a jump at 1 s
  CHECK(judge.measure(30) == fmi3OK);
  judge.step_to(2);
  CHECK(judge.measure(20) == fmi3OK);       // not any more
  CHECK(judge.measure(20, 1.0) == fmi3OK);  // it still was then
  CHECK(judge.measure(20, 0.25, 1) == fmi3OK);
  CHECK(judge.measure(30, 1.5) == fmi3OK);
  CHECK(judge.count("right") == 3);
  CHECK(judge.count("wrong") == 2);
}

TEST_CASE("a jump after a long step is not blurred over the step") {
  GroundTruth judge(0.5, 0.16);
  judge.set_truth(20);
  judge.step_to(60);  // as after a suspension
  judge.set_truth(30);
  judge.step_to(61);
  CHECK(judge.measure(25, 30) == fmi3OK);
  CHECK(judge.unit().real("last.error") == 5);
  CHECK(judge.measure(25, 0.5) == fmi3OK);
  CHECK(judge.unit().real("last.error") == -5);
  CHECK(judge.measure(20, 0.5) == fmi3OK);
  CHECK(judge.unit().real("last.error") == -10);
}

TEST_CASE("what cannot be is an error that names it") {
  GroundTruth negative;
  CHECK(negative.measure(20, -1) == fmi3Error);
  CHECK_THAT(negative.unit().last_message(),
             Contains("measurement.age is -1 s: expected 0 to 1e15 s"));
  GroundTruth endless;
  CHECK(endless.measure(20, 0, 1e300) == fmi3Error);
  CHECK_THAT(endless.unit().last_message(), Contains("measurement.age_resolution is 1e+300 s"));
}

TEST_CASE("steps that are split, states that are restored and instances that take over") {
  for (unsigned seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution(low, high)(random);
    };
    const double max_age = seed % 2 == 0 ? 0.0 : uniform(0, 2);
    GroundTruth whole(0.4, max_age);
    GroundTruth split(0.4, max_age);
    GroundTruth heir(0.1, 5.0);  // with other parameters, until it gets the state
    fmi3FMUState saved = nullptr;
    for (double time = 0; time < 20;) {
      const double truth = uniform(20, 22);
      const double next = time + uniform(0.1, 2);
      whole.set_truth(truth);
      split.set_truth(truth);
      REQUIRE(library().GetFMUState(split.unit().handle, &saved) == fmi3OK);
      split.step_to(next + 1);  // taken back
      REQUIRE(library().SetFMUState(split.unit().handle, saved) == fmi3OK);
      whole.step_to(next);
      for (double at = time; at < next;) {
        at = std::min(next, at + uniform(0.01, 1));
        split.step_to(at);
      }
      time = next;
      const double value = uniform(19.5, 22.5);
      const double age = uniform(0, 1) < 0.5 ? 0.0 : uniform(0, 5);
      const double resolution = uniform(0, 1) < 0.5 ? 0.0 : 1.0;
      if (uniform(0, 1) < 0.5) continue;
      REQUIRE(whole.measure(value, age, resolution) == fmi3OK);
      REQUIRE(split.measure(value, age, resolution) == fmi3OK);
      REQUIRE(split.state() == whole.state());
    }
    REQUIRE(library().FreeFMUState(split.unit().handle, &saved) == fmi3OK);
    CHECK(whole.count("right") > 0);
    REQUIRE(library().GetFMUState(whole.unit().handle, &saved) == fmi3OK);
    REQUIRE(library().SetFMUState(heir.unit().handle, saved) == fmi3OK);
    REQUIRE(library().FreeFMUState(heir.unit().handle, &saved) == fmi3OK);
    CHECK(heir.state() == whole.state());
    REQUIRE(heir.measure(21, 3) == fmi3OK);
    REQUIRE(whole.measure(21, 3) == fmi3OK);
    CHECK(heir.state() == whole.state());
  }
}
