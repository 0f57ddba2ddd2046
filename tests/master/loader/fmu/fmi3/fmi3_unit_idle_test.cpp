// A unit's promises to be idle, and its tangents, through the unit port.
#include <array>
#include <cmath>
#include <limits>

#include "master/loader/fmu/fmi3/fmi3_unit.h"
#include "master/loader/fmu/fmu.h"
#include "tests/counting_allocator.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::ValueBlock;
using core::ValueType;

namespace {

struct Idler {
  explicit Idler(const std::string& name = "idler") : fmu(importer::Fmu::load(test_fmu(name))) {
    unit = make_unit(fmu, "tank", {.early_return_allowed = true});
  }

  core::ValueReference reference(const std::string& name) const {
    return fmu->description()->variables[fmu->description()->find(name).value()].reference;
  }
  void set(const std::string& name, const std::string& text) {
    const auto place = fmu->description()->find(name).value();
    const core::Variable& target = fmu->description()->variables[place];
    unit->set(std::span(&target.reference, 1), core::parse(target, text));
  }
  double real(const std::string& name) {
    ValueBlock block(ValueType::Float64, 1);
    const core::ValueReference r = reference(name);
    unit->get(std::span(&r, 1), block);
    return block.numbers<double>()[0];
  }
  double slope(const std::string& name) {
    double value = std::numeric_limits<double>::quiet_NaN();
    const core::ValueReference r = reference(name);
    idle(*unit).get_derivatives(std::span(&r, 1), std::span(&value, 1));
    return value;
  }
  void start(Time at = {}) {
    unit->enter_initialization(at, std::nullopt);
    unit->exit_initialization();
    unit->update_discrete_states();
    unit->enter_step_mode();
  }

  std::shared_ptr<importer::Fmu> fmu;
  std::unique_ptr<core::Unit> unit;
};

}  // namespace

TEST_CASE("a promise is exact, to the picosecond") {
  Idler idler;
  idle(*idler.unit).enable_idle_skipping(10s);
  idler.set("rate", "0");
  idler.set("period", "0.123456789012");
  idler.start(Time(1s));
  CHECK(idle(*idler.unit).idle_until() == Time(Duration(1'123'456'789'012)));
}

TEST_CASE("a promise is at most as long as skipping was enabled for") {
  Idler idler;
  SECTION("for a while") {
    idle(*idler.unit).enable_idle_skipping(250ms);
    idler.set("rate", "0");
    idler.start(Time(1s));
    CHECK(idle(*idler.unit).idle_until() == Time(1250ms));
  }
  SECTION("for ever") {
    idle(*idler.unit).enable_idle_skipping(Duration::max());
    idler.set("rate", "0");
    idler.start(Time(1s));
    CHECK(idle(*idler.unit).idle_until() == Time::max());
  }
}

TEST_CASE("nothing is promised unless it is enabled") {
  Idler idler;
  idler.set("rate", "0");
  idler.start();
  const auto calls = diagnostics(*idler.unit).calls();
  CHECK(idle(*idler.unit).idle_until() == Time::min());
  CHECK(diagnostics(*idler.unit).calls() == calls);
}

TEST_CASE("a tighter tolerance is a shorter promise") {
  const auto promise = [](double tolerance) {
    Idler idler;
    idle(*idler.unit).enable_idle_skipping(1000s);
    const core::ValueReference level = idler.reference("level");
    idle(*idler.unit).set_idle_tolerances(std::span(&level, 1), std::span(&tolerance, 1));
    idler.start();
    return to_seconds(idle(*idler.unit).idle_until());
  };
  CHECK(promise(1e-6) == Approx(promise(1e-4) / 10).epsilon(1e-2));
}

TEST_CASE("a derivative is that of the output") {
  Idler idler;
  idler.start();
  CHECK(idler.slope("level") == 0.01);
  idler.unit->step({Time(0s), Time(1s)});
  CHECK(idler.slope("level") == 0.01 * (1 - idler.real("level")));
}

TEST_CASE("an output without a tolerance has no tangent") {
  Idler idler;
  idler.start();
  CHECK_THAT(run_error([&] { idler.slope("reports"); }),
             Contains("tank") && Contains("is not an output with a tolerance"));
}

TEST_CASE("an output whose manifest gives it no derivative has the derivative 0") {
  const Scratch scratch;
  const importer::UnpackedFmu unpacked(test_fmu("idler"));
  const fs::path manifest = unpacked.folder() / STRIDE_IDLE_MANIFEST;
  std::string text = read(manifest);
  const std::string word = "hasDerivative=\"true\"";
  text.replace(text.find(word), word.size(), "hasDerivative=\"false\"");
  std::ofstream(manifest) << text;
  const auto fmu = importer::Fmu::load(unpacked.folder());
  const auto unit = make_unit(fmu, "tank");
  unit->enter_initialization({}, std::nullopt);
  unit->exit_initialization();
  unit->enter_step_mode();
  const auto level = fmu->description()->variables[fmu->description()->find("level").value()];
  double slope = 7;
  idle(*unit).get_derivatives(std::span(&level.reference, 1), std::span(&slope, 1));
  CHECK(slope == 0);
}

TEST_CASE("asking for a promise and its tangents takes no memory") {
  Idler idler;
  idle(*idler.unit).enable_idle_skipping(10s);
  idler.start();
  const core::ValueReference level = idler.reference("level");
  double slope = 0;
  idle(*idler.unit).get_derivatives(std::span(&level, 1), std::span(&slope, 1));
  const long before = allocations;
  for (int i = 0; i < 100; ++i) {
    static_cast<void>(idle(*idler.unit).idle_until());
    idle(*idler.unit).get_derivatives(std::span(&level, 1), std::span(&slope, 1));
  }
  CHECK(allocations == before);
}

TEST_CASE("the unit's own refusal is the reason of the error") {
  Idler idler;
  CHECK_THAT(run_error([&] { idle(*idler.unit).enable_idle_skipping(Duration(0)); }),
             Contains("strideEnableIdleSkipping returned fmi3Error: maxSkip is 0 s"));
  Idler another;
  const core::ValueReference reports = another.reference("reports");
  const double tolerance = 1;
  CHECK_THAT(
      run_error([&] {
        idle(*another.unit).set_idle_tolerances(std::span(&reports, 1), std::span(&tolerance, 1));
      }),
      Contains("strideSetIdleTolerances") && Contains("'reports'"));
}

TEST_CASE("a unit without a manifest makes no promises") {
  CHECK(Idler("types").unit->capability<core::IdlePromises>() == nullptr);
}

TEST_CASE("idle units of every kind break their promises where they are stepped over them") {
  const auto step = [](const char* promise) {
    Idler idler;
    idle(*idler.unit).enable_idle_skipping(10s);
    idler.set("promise", promise);
    idler.start();
    REQUIRE(idle(*idler.unit).idle_until() > Time(1s));
    const double tangent = idler.real("level") + idler.slope("level") * 1;
    const core::StepResult result = idler.unit->step({Time(0s), Time(1s)});
    return std::pair(result, std::abs(idler.real("level") - tangent));
  };
  const auto [honest, error] = step("honest");
  CHECK_FALSE((honest.rejected || honest.early_return || honest.event_handling_needed));
  CHECK(error < 1e-3);
  CHECK(step("ticks").first.event_handling_needed);
  CHECK(step("returns_early").first.early_return);
  CHECK(step("rejects").first.rejected);
}

TEST_CASE("a unit that drifts from its tangent promises more than holds") {
  Idler idler;
  idle(*idler.unit).enable_idle_skipping(1000s);
  idler.set("promise", "drifts");
  idler.start();
  const Time until = idle(*idler.unit).idle_until();
  const double slope = idler.slope("level");
  idler.unit->step({Time(0s), until});
  CHECK(std::abs(idler.real("level") - slope * to_seconds(until)) > 1e-3);
}

TEST_CASE("what another tool's unit promises is checked") {
  const Scratch scratch;
  const fs::path folder = make_raw_fmu(scratch, "raw_extended");
  scratch.write("raw_extended/modelDescription.xml",
                description_text("raw_extended", "maxOutputDerivativeOrder=\"1\"",
                                 "<Float64 name=\"y\" valueReference=\"1\" "
                                 "causality=\"output\"/>\n"));
  scratch.write(std::string("raw_extended/") + STRIDE_IDLE_MANIFEST,
                "<fmiLayeredStandardManifest xmlns:ls=\"http://fmi-standard.org/fmi-ls-manifest\" "
                "ls:fmi-ls-name=\"org.stride.idle\" ls:fmi-ls-version=\"1.0.0\">"
                "<Output name=\"y\" valueReference=\"1\" tolerance=\"1\" "
                "hasDerivative=\"true\"/></fmiLayeredStandardManifest>");
  const auto fmu = importer::Fmu::load(folder);
  const auto promise = [&](const char* behaviour) {
    const auto unit = make_unit(fmu, behaviour);
    idle(*unit).enable_idle_skipping(1s);
    return idle(*unit).idle_until();
  };
  CHECK(promise("plain") == Time(500ms));
  CHECK(promise("sleeps") == Time(1'000'000'000s));
  CHECK_THAT(run_error([&] { promise("dreams"); }),
             Contains("'dreams'") && Contains("the promise of strideGetIdlePromise is nan"));
  CHECK_THAT(run_error([&] { promise("shy"); }),
             Contains("strideGetIdlePromise returned fmi3Error: I do not know"));

  const auto unit = make_unit(fmu, "plain");
  const core::ValueReference y = 1;
  double slope = 0;
  CHECK_THAT(
      run_error([&] { idle(*unit).get_derivatives(std::span(&y, 1), std::span(&slope, 1)); }),
      Contains("does not export fmi3GetOutputDerivatives"));
}
