// What a journal costs.
#include "master/observe/checkpoint/journal.h"

#include <catch2/catch.hpp>

#include "tests/at.h"

using namespace stride;
using namespace stride::tests;
using checkpoint::Journal;

namespace {

/// Steps of 1 ms with `size` inputs, of which some change.
void add_steps(Journal& journal, int steps, std::size_t size, int changing) {
  core::ValueBlock inputs(core::ValueType::Float64, size), outputs(core::ValueType::Float64, size);
  std::vector<core::ValueReference> references(size);
  for (std::size_t i = 0; i < size; ++i) references[i] = static_cast<core::ValueReference>(i);
  const core::BoundValues in(references, inputs), out(references, outputs);
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < changing; ++k) inputs.numbers<double>()[k] = 1.0 / (1 + i + k);
    outputs.numbers<double>()[0] = i;
    const Time from(i * Duration(1'000'000'000));
    const core::StepInterval interval(from, from + Duration(1'000'000'000));
    journal.add_step(interval, {{&in, 1}, {&out, 1}});
    journal.add_step_end({.reached = interval.to}, {&out, 1});
  }
}

Journal::Mark end_of(int steps, std::size_t size, int changing) {
  Journal journal;
  add_steps(journal, steps, size, changing);
  return journal.mark();
}

}  // namespace

TEST_CASE("a step takes ten bytes, and those of the values that change") {
  CHECK(end_of(1001, 100, 0).position - end_of(1, 100, 0).position <= 10 * 1000);
  const auto bytes = end_of(1001, 100, 2).position - end_of(1, 100, 2).position;
  CHECK(bytes <= (10 + 13 + 2 * 8) * 1000);
}

TEST_CASE("a million steps fit into little memory") {
  Journal journal;
  add_steps(journal, 1'000'000, 10, 0);
  CHECK(journal.memory() < 4'000'000);
}
