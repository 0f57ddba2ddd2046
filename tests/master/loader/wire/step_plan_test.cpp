#include "master/loader/wire/step_plan.h"

#include <deque>

#include <catch2/catch.hpp>

using namespace stride;
using namespace stride::isolation;
using core::ValueBlock;
using core::ValueType;

namespace {

/// Values of a step: one input of this type and size, one output.
struct Values {
  Values(std::vector<core::ValueReference> references, ValueType type = ValueType::Float64)
      : inputs_of(std::move(references)),
        in(type, inputs_of.size()),
        inputs{{inputs_of, in}},
        outputs{{output_of, out}} {}
  core::StepValues step() const { return {inputs, outputs}; }

  std::vector<core::ValueReference> inputs_of, output_of{7};
  ValueBlock in, out{ValueType::Float64, 1};
  std::vector<core::BoundValues> inputs, outputs;
};

}  // namespace

TEST_CASE("a plan is found by its references and types, not by their addresses") {
  KnownStepShapes plans;
  CHECK_FALSE(plans.find(Values({1, 2}).step()));
  CHECK(plans.add(Values({1, 2}).step()) == 0);
  CHECK(plans.find(Values({1, 2}).step()) == 0U);
  CHECK_FALSE(plans.find(Values({1, 3}).step()));
  CHECK_FALSE(plans.find(Values({1}).step()));
  CHECK_FALSE(plans.find(Values({1, 2}, ValueType::Int64).step()));
  CHECK_FALSE(plans.find(core::StepValues{}));
  CHECK(plans.add(core::StepValues{}) == 1);
  CHECK(plans.find(core::StepValues{}) == 1U);
  CHECK(plans.find(Values({1, 2}).step()) == 0U);
  plans.forget();
  CHECK_FALSE(plans.find(Values({1, 2}).step()));
}

TEST_CASE("of many plans the oldest lose their numbers") {
  KnownStepShapes plans;
  for (std::uint32_t i = 0; i < KnownStepShapes::kMost + 3; ++i) {
    CHECK(plans.add(Values({i}).step()) == i % KnownStepShapes::kMost);
  }
  CHECK_FALSE(plans.find(Values({2}).step()));
  CHECK(plans.find(Values({3}).step()) == 3U);
  CHECK(plans.find(Values({KnownStepShapes::kMost}).step()) == 0U);
}

TEST_CASE("a served plan has memory for the values of its request") {
  Values values({4, 5});
  values.in.numbers<double>()[1] = 2.5;
  isolation::GrowingMemory memory("test", 64);
  PacketWriter out(memory);
  put_shape(out, values.step());
  for (const core::BoundValues& input : values.inputs) {
    out.put_bytes(input.block->bytes(), 2 * sizeof(double));
  }
  PacketReader in({memory.data(), out.size()});
  StepBuffers plan(take_step_shape(in));
  plan.take_inputs(in);
  REQUIRE(plan.values().inputs.size() == 1);
  CHECK(plan.values().inputs[0].references[1] == 5);
  CHECK(plan.values().inputs[0].float64s[1] == 2.5);
  REQUIRE(plan.values().outputs.size() == 1);
  plan.values().outputs[0].block->numbers<double>()[0] = -1;
  PacketWriter answer(memory);
  plan.put_outputs(answer);
  CHECK(PacketReader({memory.data(), answer.size()}).take<double>() == -1);
}
