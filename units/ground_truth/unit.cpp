// The judge of measurements as an FMU. The units of its variables come from its resources.
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <stride/unit.h>

#include "units/ground_truth/model.h"
#include "units/ground_truth/quantity.h"
#include "units/ground_truth/text.h"

namespace {

using ground_truth::Comparison;
using ground_truth::Finding;

ground_truth::Quantity load(const std::filesystem::path& resources) {
  if (resources.empty()) {
    throw std::runtime_error("the unit has no resources folder: expected one with quantity.xml");
  }
  return ground_truth::read_quantity((resources / "quantity.xml").string());
}

stride::Duration duration(const char* name, double seconds) {
  if (seconds >= 0.0 && seconds <= stride::kMaxSeconds) {
    return stride::duration_from_seconds(seconds);
  }
  throw std::invalid_argument(std::string(name) + " is " +
                              ground_truth::quantity_text(seconds, "s") + ": expected 0 to 1e15 s");
}

}  // namespace

class GroundTruth : public stride::Unit {
 public:
  explicit GroundTruth(const stride::Setup& setup)
      : quantity_(load(setup.resources)), judge_({}, quantity_) {
    describe("Compares measurements that were received with what was true").promises_idle = true;
    list_inputs();
    list_parameters();
    list_outputs();
    auto& history = judge_.history().state();
    auto& found = judge_.state();
    state(history.pieces, history.last, history.value, found.last, found.worst);
  }

  void initialize(stride::Time) override {
    judge_ = ground_truth::Judge(parameters(), quantity_);
    show();
  }

  void step(stride::Step& step) override { judge_.note(step.from(), truth_); }

  void event(stride::Event& event) override {
    judge_.note(event.time(), truth_);
    if (!clock_.ticked()) return;
    const Comparison comparison =
        judge_.compare({event.time(), value_, duration("measurement.age", age_),
                        duration("measurement.age_resolution", age_resolution_)});
    if (comparison.finding != Finding::Right) {
      log(stride::Severity::Warning, judge_.text_of(comparison));
    }
    show();
  }

  // nothing happens by itself: the inputs end each promise
  stride::Time idle_until(stride::Time) const override { return stride::Time::max(); }

  // a state may come from an instance with other parameters
  void load_state(stride::StateReader&) override { judge_.configure(parameters()); }

 private:
  void list_inputs() {
    input("truth", truth_).unit(quantity_.unit).description("what is to be measured, as it is");
    input("measurement.clock", clock_).description("ticks when a measurement has been received");
    input("measurement.value", value_)
        .unit(quantity_.unit)
        .clocked_by(clock_)
        .description("what was measured");
    input("measurement.age", age_)
        .unit("s")
        .min(0)
        .clocked_by(clock_)
        .description("age of the measurement, as reported");
    input("measurement.age_resolution", age_resolution_)
        .unit("s")
        .min(0)
        .clocked_by(clock_)
        .description("by how much it may be older, because its age is rounded down");
  }

  void list_parameters() {
    parameter("tolerance", tolerance_)
        .unit(quantity_.difference)
        .min(0)
        .description("largest error that is right");
    parameter("max_age", max_age_)
        .unit("s")
        .range(0, stride::kMaxSeconds)
        .description("by how much a measurement may be older than reported");
    parameter("memory", memory_)
        .unit("s")
        .range(0, stride::kMaxSeconds)
        .description("for how long the truth is remembered");
    parameter("minimum_measurements", minimum_)
        .description("the verdict is not good with fewer comparisons");
  }

  void list_outputs() {
    output("passed", passed_)
        .depends_on({})
        .verdict()
        .description("nothing was wrong, and enough was compared");
    output("text", text_).depends_on({}).verdict_text().description("the verdict in words");
    auto& found = judge_.state();
    list_count("right", found.right, "measurements that are right");
    list_count("wrong", found.wrong, "measurements that are not");
    list_count("unknown", found.unknown, "measurements of whose time the truth is not remembered");
    list_number("last.error", found.last.error, quantity_.difference,
                "of the last measurement that was compared: measured less true");
    list_number("worst.error", found.worst.error, quantity_.difference, "the largest one");
    list_number("worst.time", worst_time_, "s", "when this measurement was received");
    list_number("worst.measured", found.worst.measured, quantity_.unit, "measured value");
    list_number("worst.truth", found.worst.truth, quantity_.unit, "the nearest that was true");
  }

  void list_count(const std::string& name, std::uint64_t& count, const char* meaning) {
    output("measurements." + name, count).depends_on({}).description(meaning);
  }

  void list_number(const char* name, double& value, const std::string& unit, const char* meaning) {
    output(name, value).unit(unit).discrete().depends_on({}).description(meaning);
  }

  ground_truth::Parameters parameters() const {
    return {tolerance_, duration("max_age", max_age_), duration("memory", memory_), minimum_};
  }

  void show() {
    passed_ = judge_.passed();
    text_ = judge_.verdict_text();
    worst_time_ = stride::to_seconds(judge_.state().worst.received);
  }

  ground_truth::Quantity quantity_;
  ground_truth::Judge judge_;

  double truth_ = 0.0;
  stride::Clock clock_;
  double value_ = 0.0;
  double age_ = 0.0;             // [s]
  double age_resolution_ = 0.0;  // [s]

  double tolerance_ = 0.1;
  double max_age_ = 0.1;  // [s]
  double memory_ = 60.0;  // [s]
  std::uint64_t minimum_ = 1;

  bool passed_ = false;
  std::string text_;
  double worst_time_ = 0.0;  // [s]
};

STRIDE_UNIT(GroundTruth)
