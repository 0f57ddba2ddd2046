#include "master/loader/wire/step_plan.h"

#include <algorithm>
#include <optional>

#include "master/loader/wire/codec.h"

namespace stride::isolation {
namespace {

using Bound = std::span<const core::BoundValues>;

std::vector<StepShape::Group> shape(Bound values) {
  std::vector<StepShape::Group> parts;
  for (const core::BoundValues& part : values) {
    parts.push_back(
        {part.block->type(), part.block->size(), {part.references.begin(), part.references.end()}});
  }
  return parts;
}

bool fits(const std::vector<StepShape::Group>& shape, Bound values) {
  return std::ranges::equal(
      shape, values, [](const StepShape::Group& part, const core::BoundValues& bound) {
        return part.type == bound.block->type() && part.size == bound.block->size() &&
               std::ranges::equal(part.references, bound.references);
      });
}

void put_parts(PacketWriter& to, Bound values) {
  to.put(values.size());
  for (const core::BoundValues& part : values) {
    to.put_all(part.references);
    put_shape(to, *part.block);
  }
}

}  // namespace

// ---- In the master ----

StepShape::StepShape(const core::StepValues& values)
    : inputs(shape(values.inputs)), outputs(shape(values.outputs)) {}

bool StepShape::fits(const core::StepValues& values) const {
  return isolation::fits(inputs, values.inputs) && isolation::fits(outputs, values.outputs);
}

std::optional<std::uint32_t> KnownStepShapes::find(const core::StepValues& values) {
  if (latest_ < shapes_.size() && shapes_[latest_].fits(values)) return latest_;
  for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
    if (shapes_[i].fits(values)) return latest_ = i;
  }
  return std::nullopt;
}

std::uint32_t KnownStepShapes::add(const core::StepValues& values) {
  if (shapes_.size() < kMost) {
    shapes_.emplace_back(values);
    return latest_ = static_cast<std::uint32_t>(shapes_.size()) - 1;
  }
  latest_ = next_++ % kMost;
  shapes_[latest_] = StepShape(values);
  return latest_;
}

void put_shape(PacketWriter& to, const core::StepValues& values) {
  put_parts(to, values.inputs);
  put_parts(to, values.outputs);
}

// ---- Where the unit is ----

namespace {

std::vector<StepShape::Group> take_groups(PacketReader& from) {
  std::vector<StepShape::Group> groups;
  const std::size_t count = from.take_count(1);
  for (std::size_t i = 0; i < count; ++i) {
    auto references = from.take_all<core::ValueReference>();
    const Shape shape = take_shape(from);
    groups.push_back({shape.type, shape.size, std::move(references)});
  }
  return groups;
}

}  // namespace

StepShape take_step_shape(PacketReader& from) {
  StepShape shape;
  shape.inputs = take_groups(from);
  shape.outputs = take_groups(from);
  return shape;
}

StepBuffers::StepBuffers(const StepShape& shape)
    : inputs_(make_parts(shape.inputs)), outputs_(make_parts(shape.outputs)) {}

std::vector<core::BoundValues> StepBuffers::make_parts(
    const std::vector<StepShape::Group>& groups) {
  std::vector<core::BoundValues> bound;
  for (const StepShape::Group& group : groups) {
    Part& part =
        parts_.emplace_back(Part{group.references, core::ValueBlock(group.type, group.size)});
    bound.emplace_back(part.references, part.block);
  }
  return bound;
}

void StepBuffers::take_inputs(PacketReader& from) {
  for (const core::BoundValues& input : inputs_) take_values(from, *input.block);
}

void StepBuffers::put_outputs(PacketWriter& to) const {
  for (const core::BoundValues& output : outputs_) put_values(to, *output.block);
}

}  // namespace stride::isolation
