#include "master/study/verify/checks/damaged_states.h"

#include <algorithm>
#include <set>

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace stride::verify;

TEST_CASE("damaged states are not the state, nor one another") {
  for (const std::size_t size : {1U, 5U, 300U}) {
    const std::vector<std::uint8_t> bytes(size, 0x5A);
    std::set<std::vector<std::uint8_t>> different{bytes};
    std::size_t shortest = size;
    for (const DamagedState& state : damaged_states(bytes)) {
      different.insert(state.bytes);
      shortest = std::min(shortest, state.bytes.size());
    }
    CHECK(shortest == 0);
    if (size == 300) CHECK(different.size() == damaged_states(bytes).size() + 1);
  }
}

TEST_CASE("an instance that has refused damaged bytes goes on from the state") {
  const TestedUnit tested(VerifyRequest{.file = test_fmu("types")});
  importer::CallNote note;
  const Trial trial{tested, note};
  SerializedRun run = run_with_cuts(trial, choose_cuts(trial));
  const auto damaged = damaged_states(run.states.front().bytes);
  CHECK(accepted_states(trial, damaged).empty());
  CHECK_NOTHROW(require_refusals(trial, run, damaged));
  const DamagedState whole{"the state itself", run.states.front().bytes};
  CHECK(accepted_states(trial, {whole, whole}) ==
        std::vector<std::string>{"the state itself: accepted"});
  CHECK_THROWS_WITH(require_refusals(trial, run, {whole}), "the state itself: accepted");
  run.rows.back().values.front() += "0";
  CHECK_THROWS_AS(require_refusals(trial, run, damaged), Failure);
}
