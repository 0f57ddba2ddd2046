// A step as data. The shape of the values that go with it is sent once, so that it sends elements
// only.
#ifndef STRIDE_MASTER_LOADER_WIRE_STEP_PLAN_H
#define STRIDE_MASTER_LOADER_WIRE_STEP_PLAN_H

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "master/engine/port/unit.h"
#include "master/loader/wire/packet.h"

namespace stride::isolation {

/// What a step's values are made of, without the values.
struct StepShape {
  struct Group {
    core::ValueType type;
    std::size_t size;
    std::vector<core::ValueReference> references;
  };
  std::vector<Group> inputs, outputs;

  StepShape() = default;
  explicit StepShape(const core::StepValues& values);
  bool fits(const core::StepValues& values) const;
};

/// In the master: the shapes that the unit's process knows, by their numbers.
class KnownStepShapes {
 public:
  static constexpr std::uint32_t kMost = 16;

  /// The number of the values' shape; nothing if the process does not know it.
  std::optional<std::uint32_t> find(const core::StepValues& values);
  /// A number for a shape that is about to be sent; an older shape may lose it.
  std::uint32_t add(const core::StepValues& values);
  /// The process has lost them.
  void forget() { shapes_.clear(); }

 private:
  std::vector<StepShape> shapes_;
  std::uint32_t latest_ = 0;  ///< used; most likely the next one, too
  std::uint32_t next_ = 0;    ///< to be replaced when there is no room
};

/// Where the unit is: memory for the values of a step.
class StepBuffers {
 public:
  StepBuffers() = default;
  explicit StepBuffers(const StepShape& shape);

  void take_inputs(PacketReader& from);
  void put_outputs(PacketWriter& to) const;
  core::StepValues values() const { return {inputs_, outputs_}; }

 private:
  struct Part {
    std::vector<core::ValueReference> references;
    core::ValueBlock block;
  };
  std::vector<core::BoundValues> make_parts(const std::vector<StepShape::Group>& groups);

  std::deque<Part> parts_;  // whose elements stay where they are
  std::vector<core::BoundValues> inputs_, outputs_;
};

/// What StepBuffers is made of.
void put_shape(PacketWriter& to, const core::StepValues& values);
StepShape take_step_shape(PacketReader& from);

/// A step as it is requested, before the values of its inputs: in one piece, without gaps.
struct StepRequest {
  static constexpr std::uint8_t kMayGoBackBefore = 1, kSavesState = 2, kIsTimed = 4;

  Time from, to;
  double begin_seconds, end_seconds, size_seconds;
  std::uint32_t plan;
  std::uint8_t flags;
  std::array<std::uint8_t, 3> unused{};

  StepRequest(std::uint32_t plan_number, const core::StepInterval& interval, bool saves_state,
              bool is_timed)
      : from(interval.from),
        to(interval.to),
        begin_seconds(interval.begin_seconds),
        end_seconds(interval.end_seconds),
        size_seconds(interval.size_seconds),
        plan(plan_number),
        flags(static_cast<std::uint8_t>((interval.may_go_back_before ? kMayGoBackBefore : 0) |
                                        (saves_state ? kSavesState : 0) |
                                        (is_timed ? kIsTimed : 0))) {}
  core::StepInterval interval() const {
    core::StepInterval interval(from, begin_seconds, to, end_seconds, size_seconds);
    interval.size_seconds = size_seconds;
    interval.may_go_back_before = has(kMayGoBackBefore);
    return interval;
  }
  bool has(std::uint8_t flag) const { return (flags & flag) != 0; }
};
static_assert(sizeof(StepRequest) == 64);

}  // namespace stride::isolation

#endif
