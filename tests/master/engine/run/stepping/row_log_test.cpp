#include "master/engine/run/stepping/row_log.h"

#include <catch2/catch.hpp>

#include "tests/at.h"

using namespace stride;
using namespace stride::core;
using stride::tests::at;

TEST_CASE("a row's log has the last steps, and each unit's numbers in them") {
  ValueBlock pair(ValueType::Float64, 2), single(ValueType::Float64, 1),
      none(ValueType::Float64, 0);
  const BoundValues inputs[] = {{{}, pair}, {{}, single}}, empty({}, none);
  const StepValues units[] = {
      {{inputs, 1}, {inputs + 1, 1}}, {}, {{inputs + 1, 1}, {inputs, 1}}, {{&empty, 1}, {}}};
  RowLog log(units);
  log.make_room(3);
  CHECK(log.step_size() == 3 * sizeof(double) + sizeof(StepInterval));
  for (int i = 0; i < 9; ++i) {
    pair.numbers<double>()[0] = i;
    pair.numbers<double>()[1] = 10 + i;
    single.numbers<double>()[0] = 20 + i;
    const StepInterval step(at(i), at(i + 1));
    CHECK(log.begin_step(step, i > 0).may_go_back_before == (i > 0));
    log.end_step();
  }
  REQUIRE(log.end() == 9);
  for (const int i : {5, 6, 7, 8}) {
    const auto position = static_cast<std::uint64_t>(i);
    CHECK(log.interval(position).from == at(i));
    const auto first = log.inputs(0, position);
    CHECK(std::vector(first.begin(), first.end()) == std::vector<double>{1.0 * i, 10.0 + i});
    CHECK(log.inputs(1, position).empty());
    CHECK(log.inputs(2, position)[0] == 20 + i);
    CHECK(log.inputs(3, position).empty());
  }
  CHECK(log.outputs_before(0)[0] == 28);
  CHECK(log.outputs_before(2)[1] == 18);
  log.restart();
  CHECK(log.end() == 0);
}
