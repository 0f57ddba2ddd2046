// Units that step in a row, and the same units stepping one by one.
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/base/process/processor_mode.h"
#include "master/engine/port/capabilities/steps_in_a_row.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::StepInterval;
using core::StepsInARow;
using core::UnitRow;

namespace {

/// Rows are quick when 100 calls of each unit are over.
constexpr int kSteps = 150;

/// Three units of one FMU, initialised up to Step Mode. What they do is noted.
class Trio {
 public:
  Trio(const fs::path& file, const std::vector<std::string>& names)
      : fmu_(importer::Fmu::load(file)) {
    importer::InstanceOptions options{.early_return_allowed = true};
    options.log = [this](const std::string& unit, importer::Status, const std::string&,
                         const std::string& message) { log += unit + ": " + message + "\n"; };
    for (const std::string& name : names) {
      units_.push_back(fmu_->instantiate(name, options));
      blocks_.emplace_back(core::ValueType::Float64, 1);
    }
    for (auto& unit : units_) {
      unit->enter_initialization({}, Time(100s));
      unit->exit_initialization();
      unit->update_discrete_states();
      unit->enter_step_mode();
    }
  }

  /// Each sets `input` to its value of the step before, and reads `output`.
  void connect(const std::string& input, const std::string& output) {
    input_ = reference(input);
    output_ = reference(output);
    for (core::ValueBlock& block : blocks_) {
      inputs_.emplace_back(std::span(&input_, 1), block);
      outputs_.emplace_back(std::span(&output_, 1), block);
    }
  }
  std::unique_ptr<UnitRow> row() {
    std::vector<StepsInARow::Member> members;
    for (std::size_t i = 0; i < units_.size(); ++i) members.push_back({units_[i].get(), values(i)});
    return units_.front()->require_capability<StepsInARow>().make_row(members);
  }
  void step_one_by_one(const StepInterval& interval, UnitRow::Progress& progress) {
    for (std::size_t i = 0; i < units_.size(); ++i) {
      progress.result = units_[i]->step(interval, values(i));
      if (!progress.result.reached_without_request(interval.to)) return;
      ++progress.plain;
    }
  }
  std::string numbers() {
    std::string text;
    for (std::size_t i = 0; i < units_.size(); ++i) {
      const auto calls = units_[i]->require_capability<core::UnitDiagnostics>().calls();
      text += fmt::format("{} calls, {}\n", calls, blocks_[i].numbers<double>()[0]);
    }
    return text;
  }

  /// So that the first unit is not closely watched any more.
  void call_first(int times) {
    const core::ValueReference time = reference("time");
    core::ValueBlock value(core::ValueType::Float64, 1);
    for (int k = 0; k < times; ++k) units_.front()->get(std::span(&time, 1), value);
  }

  std::string log;

 private:
  core::StepValues values(std::size_t i) const {
    if (inputs_.empty()) return {};
    return {std::span(&inputs_[i], 1), std::span(&outputs_[i], 1)};
  }
  core::ValueReference reference(const std::string& name) const {
    return fmu_->description()->variables[fmu_->description()->find(name).value()].reference;
  }

  std::shared_ptr<importer::Fmu> fmu_;
  std::vector<std::unique_ptr<core::Unit>> units_;
  std::vector<core::ValueBlock> blocks_;
  core::ValueReference input_ = 0, output_ = 0;
  std::vector<core::BoundValues> inputs_, outputs_;
};

/// What comes of so many steps, or of those up to a failure.
template <class Step>
std::string outcome(Trio& units, int steps, Step&& step) {
  std::string text;
  for (int k = 0; k < steps; ++k) {
    UnitRow::Progress progress;
    std::string failure;
    try {
      step(StepInterval(Time(k * 100ms), Time((k + 1) * 100ms)), progress);
    } catch (const core::Error& error) {
      failure = error.what();
    }
    const core::StepResult& result = progress.result;
    text += fmt::format("{} plain", progress.plain);
    if (failure.empty() && progress.plain < 3) {
      text += fmt::format(", {} {} {} {} {}", result.rejected, result.early_return,
                          result.event_handling_needed, result.terminate_simulation,
                          result.reached.time_since_epoch().count());
    }
    text += " " + failure + "\n";
    if (!failure.empty()) break;
  }
  return text + units.numbers() + units.log;
}

void step_row(UnitRow& row, int from, int to) {
  for (int k = from; k < to; ++k) {
    UnitRow::Progress progress;
    CHECK(row.step(StepInterval(Time(k * 100ms), Time((k + 1) * 100ms)), progress));
  }
}

/// What the units `meddler` do, as long as it lives.
struct Meddling {
  explicit Meddling(const char* wish) { ::setenv("STRIDE_MEDDLE", wish, 1); }
  ~Meddling() { ::unsetenv("STRIDE_MEDDLE"); }
};

}  // namespace

TEST_CASE("units in a row do, answer and fail as they do one by one") {
  const std::string what =
      GENERATE("plain", "needs", "ends", "early", "arrives", "lies", "strays", "drifts", "warning",
               "babbles", "mumbles", "fatal", "error", "discard", "pending", "unheard", "insists");
  const std::string name = what + GENERATE("", "@120");  // while it is closely watched, and later
  INFO(name);
  const Scratch scratch, other_scratch;
  Trio in_row(make_raw_fmu(scratch, "raw"), {"a", name, "c"});
  Trio alone(make_raw_fmu(other_scratch, "raw"), {"a", name, "c"});
  const auto row = in_row.row();
  REQUIRE(row != nullptr);
  REQUIRE(row->size() == 3);
  const std::string expected =
      outcome(alone, kSteps, [&](const StepInterval& interval, UnitRow::Progress& progress) {
        alone.step_one_by_one(interval, progress);
      });
  CHECK(outcome(in_row, kSteps, [&](const StepInterval& interval, UnitRow::Progress& progress) {
          if (row->step(interval, progress)) progress.plain = row->size();
        }) == expected);
}

TEST_CASE("units in a row set their inputs and get their outputs") {
  Trio in_row(test_fmu("meddler"), {"a", "b", "c"}), alone(test_fmu("meddler"), {"a", "b", "c"});
  in_row.connect("u", "sum");
  alone.connect("u", "sum");
  const auto row = in_row.row();
  REQUIRE(row != nullptr);
  step_row(*row, 0, kSteps);
  for (int k = 0; k < kSteps; ++k) {
    UnitRow::Progress progress;
    alone.step_one_by_one(StepInterval(Time(k * 100ms), Time((k + 1) * 100ms)), progress);
  }
  CHECK(in_row.numbers() == alone.numbers());
  CHECK_THAT(in_row.numbers(), !Contains(" 0\n"));
}

TEST_CASE(
    "a unit of a row that leaves another mode of the processor is named, others lose nothing") {
  Trio in_row(test_fmu("meddler"), {"a", "b", "c"}), alone(test_fmu("meddler"), {"a", "b", "c"});
  in_row.connect("u", "sum");
  alone.connect("u", "sum");
  const auto row = in_row.row();
  step_row(*row, 0, 60);  // so that its calls are not among the first ones
  const auto mode = core::ProcessorMode::present();
  {
    const Meddling meddling(GENERATE("step rounding", "step flush", "step exceptions"));
    step_row(*row, 60, 61);
  }
  CHECK(core::ProcessorMode::present() == mode);
  for (const char* unit : {"a", "b", "c"}) {
    CHECK_THAT(in_row.log, Contains(std::string(unit) + ": fmi3DoStep left another mode"));
  }
  for (int k = 0; k < 61; ++k) {
    UnitRow::Progress progress;
    alone.step_one_by_one(StepInterval(Time(k * 100ms), Time((k + 1) * 100ms)), progress);
  }
  CHECK(in_row.numbers() == alone.numbers());
}

#if defined(__x86_64__)
TEST_CASE("signals by exceptions of SSE alone are seen behind the row, and their unit is named") {
  const Scratch scratch;
  std::vector<std::string> names{"a", "b", "c"};
  const std::size_t i = GENERATE(0, 1, 2);
  names[i] = "signals@120";
  Trio units(make_raw_fmu(scratch, "raw"), names);
  const auto row = units.row();
  const auto mode = core::ProcessorMode::present();
  step_row(*row, 0, kSteps);
  CHECK(core::ProcessorMode::present() == mode);
  CHECK_THAT(units.log, Catch::Matchers::StartsWith("signals@120: fmi3DoStep left another mode"));
  CHECK(std::ranges::count(units.log, '\n') == 1);
}

TEST_CASE("the unit that leaves signals behind is named where another one fails in the same row") {
  const Scratch scratch;
  Trio units(make_raw_fmu(scratch, "raw"), {"a", "signals@120", "error@120"});
  const auto row = units.row();
  step_row(*row, 0, 120);
  const auto mode = core::ProcessorMode::present();
  UnitRow::Progress progress;
  CHECK_THROWS_AS(row->step(StepInterval(Time(12s), Time(12100ms)), progress), core::Error);
  CHECK(progress.plain == 2);
  CHECK(core::ProcessorMode::present() == mode);
  CHECK_THAT(units.log, Contains("signals@120: fmi3DoStep left another mode"));
}

TEST_CASE("the unit that leaves signals behind is named, not one whose first calls are watched") {
  const Scratch scratch;
  Trio units(make_raw_fmu(scratch, "raw"), {"signals@20", "b", "c"});
  units.call_first(100);
  const auto row = units.row();
  step_row(*row, 0, 40);
  CHECK_THAT(units.log, Contains("signals@20: fmi3DoStep left another mode"));
  CHECK_THAT(units.log, !Contains("b: fmi3DoStep"));
}
#endif
