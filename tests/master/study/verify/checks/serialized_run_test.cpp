#include "master/study/verify/checks/serialized_run.h"

#include <algorithm>

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace stride::verify;

namespace {

struct Bench {
  explicit Bench(const std::string& unit) : tested(VerifyRequest{.file = test_fmu(unit)}) {}

  TestedUnit tested;
  importer::CallNote note;
  Trial trial{tested, note};
};

std::vector<std::string> places(const std::vector<Cut>& cuts) {
  std::vector<std::string> names;
  for (const Cut& cut : cuts) names.push_back(cut.place);
  return names;
}

}  // namespace

TEST_CASE("states are taken at 30 % of a run, and around an event and a tick") {
  Bench types("types");
  const std::vector<Cut> cuts = choose_cuts(types.trial);
  CHECK(cuts.front().point == 60);
  CHECK(std::ranges::is_sorted(cuts, {}, &Cut::order));
  for (const Cut& cut : cuts) CHECK(cut.point < 160);
  const std::vector<std::string> names = places(cuts);
  CHECK(std::ranges::find(names, "right after an event") != names.end());
  Bench idler("idler");
  const std::vector<std::string> with_ticks = places(choose_cuts(idler.trial));
  for (const char* place :
       {"before a clock ticks", "where a clock ticks", "after a clock has ticked"}) {
    CAPTURE(place);
    CHECK(std::ranges::find(with_ticks, place) != with_ticks.end());
  }
}

TEST_CASE("what follows a state in a fresh instance is what followed in the run") {
  Bench bench(GENERATE("types", "clocks", "oscillator_mass"));
  const SerializedRun run = run_with_cuts(bench.trial, choose_cuts(bench.trial));
  const SerializedRun sent = serialized_run_from_text(to_text(run));
  REQUIRE(sent.states.size() == run.states.size());
  CHECK(sent.rows == run.rows);
  CHECK(sent.to == 160);
  for (const SerializedState& state : sent.states) {
    CAPTURE(state.cut.place);
    TestInstance instance = bench.trial.make_instance();
    restore(bench.trial, instance, state);
    CHECK(instance.now() == state.position.now);
    finish_from(instance, state, sent.to);
    CHECK(instance.recording().rows == run.rows_after(state));
    CHECK(run.rows_after(state).size() >= 160 - state.cut.point);
  }
}
