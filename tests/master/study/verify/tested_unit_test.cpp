#include "master/study/verify/tested_unit.h"

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace stride::verify;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

fs::path minimal() { return unit_folder() / "minimal.fmu"; }

/// A unit that declares these.
TestedUnit declaring(const std::string& flags, const std::string& experiment,
                     const VerifyRequest& request = {}) {
  const Scratch scratch;
  make_raw_fmu(scratch, "raw", flags);
  std::string text = read(scratch / "raw/modelDescription.xml");
  text.insert(text.find("<ModelVariables>"), experiment);
  scratch.write("raw/modelDescription.xml", text);
  VerifyRequest asked = request;
  asked.file = scratch / "raw";
  return TestedUnit(asked);
}

}  // namespace

TEST_CASE("step and stop are the user's, else the unit's, else 1 ms and 200 steps") {
  const TestedUnit plain(VerifyRequest{.file = minimal()});
  CHECK(plain.step() == 1ms);
  CHECK(plain.steps() == 200);
  CHECK(plain.point(3) == Time(3ms));
  const TestedUnit asked(VerifyRequest{.file = minimal(), .step = 10ms, .stop = 1s});
  CHECK(asked.step() == 10ms);
  CHECK(asked.steps() == 100);

  CHECK(declaring("fixedInternalStepSize=\"0.02\"", "").step() == 20ms);
  const std::string experiment = "<DefaultExperiment stopTime=\"5\" stepSize=\"0.05\"/>";
  const TestedUnit experimental = declaring("", experiment);
  CHECK(experimental.step() == 50ms);
  CHECK(experimental.steps() == 100);
  CHECK(declaring("", experiment, {.step = 1ms}).steps() == 1000);
  const TestedUnit late = declaring(
      "",
      "<DefaultExperiment startTime=\"3600\" stopTime=\"3610\" stepSize=\"0.3333333333333333\"/>");
  CHECK(late.point(0) == Time(3600s));
  CHECK(late.steps() == 30);
  CHECK(late.point(30) == Time(3610s));
}

TEST_CASE("what is observed are outputs and locals without a clock") {
  const TestedUnit tested(VerifyRequest{.file = test_fmu("types")});
  std::size_t count = 0;
  for (const TestedUnit::Group& group : tested.observed()) {
    std::size_t size = 0;
    for (const std::size_t i : group.places) {
      const core::Variable& variable = tested.description().variables[i];
      CHECK(variable.type == group.type);
      CHECK(variable.causality == core::Causality::Output);
      CHECK_FALSE(variable.is_clocked());
      size += variable.size;
      ++count;
    }
    CHECK(group.size == size);
    CHECK(group.references.size() == group.places.size());
  }
  CHECK(count == tested.observed_count());
  CHECK(count == 19);
}

TEST_CASE("functions have the prefix of the unit's version") {
  CHECK(TestedUnit(VerifyRequest{.file = minimal()}).function("DoStep") == "fmi3DoStep");
}

TEST_CASE("a request that makes no sense is refused") {
  const auto mistake = [](const VerifyRequest& request) {
    return input_error([&] { const TestedUnit refused(request); });
  };
  CHECK_THAT(mistake({.file = "unit.so"}),
             Contains("'unit.so' is a library") && Contains("stride pack"));
  CHECK_THAT(mistake({.file = minimal(), .settings = {"y"}}), Contains("--set y: expected"));
  CHECK_THAT(mistake({.file = minimal(), .settings = {"uu=1"}}), Contains("--set uu=1"));
  CHECK_THAT(mistake({.file = minimal(), .settings = {"u=fast"}}), Contains("fast"));
  CHECK_THAT(
      mistake({.file = minimal(), .stop = 3ms}),
      Contains("there are 3 steps of 0.001 s to the stop time 0.003 s; expected 4 at least"));
  CHECK_THAT(mistake({.file = "nowhere.fmu"}), Contains("nowhere.fmu"));
}
