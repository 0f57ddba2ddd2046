#ifndef STRIDE_MASTER_LOADER_WIRE_DISPATCHER_H
#define STRIDE_MASTER_LOADER_WIRE_DISPATCHER_H

#include <array>
#include <optional>
#include <span>

#include "master/loader/wire/arguments.h"
#include "master/loader/wire/calls.h"
#include "master/loader/wire/packet.h"
#include "master/loader/wire/step_plan.h"
#include "master/loader/wire/unit_times.h"

namespace stride::isolation {

/// Thrown by the function that asks for inputs within a step: what the master did for them has
/// failed, and it knows how.
struct CallbackFailure {};

/// Carries out requests on a unit that is here. Throws what the unit throws, and BadPacket for a
/// request that cannot be.
class Dispatcher {
 public:
  /// `request_inputs`: asks the master for the inputs of an instant within a step. Requests that
  /// come meanwhile may get and set only.
  explicit Dispatcher(core::InputUpdate request_inputs);

  /// From here on there is a unit. `states`: in place of its own. `checks_sizes`: who sends
  /// requests is not trusted, so sizes are compared with the description before memory is taken.
  void begin(core::Unit& unit, const core::UnitDescription& description, core::StateSaving* states,
             bool checks_sizes);
  /// There is none any longer.
  void end() { unit_ = nullptr; }

  /// Takes the request from `in`, and puts its result into `out`. All but Instantiate.
  void serve(RequestCode request, PacketReader& in, PacketWriter& out);

  CapabilitySet capabilities() const;
  template <core::CapabilityInterface C>
  C& capability() const {
    core::Capability* const found =
        unit_ == nullptr ? nullptr : capabilities_[static_cast<std::size_t>(C::kId)];
    if (found == nullptr) throw BadPacket("a unit is asked for what it cannot");
    return static_cast<C&>(*found);
  }
  /// The simulated time of the unit.
  std::optional<Time> time() const { return times_.now; }

 private:
  using References = std::span<const core::ValueReference>;
  friend struct Rows;

  void make_plan(PacketReader& in);
  void step(PacketReader& in, PacketWriter& out);
  StepBuffers& plan(std::uint32_t number);
  template <auto function>
  void call(PacketReader& in, PacketWriter& out);
  core::Unit& unit() const;
  template <class Interface>
  Interface& target() const;

  template <auto function, class... Arguments>
  void check(const Arguments&... arguments) const;
  // Of references and what belongs to them. A call whose arguments are others needs one more.
  void check_sizes(References references, const core::ValueBlock& values) const;
  void check_sizes(References references, const FilledBlock& values) const;
  void check_sizes(References references, std::span<const double> one_each) const;
  void check_sizes(References references, const FilledNumbers& numbers) const;
  void check_sizes(References unknowns, References knowns, std::span<const double> seed,
                   const FilledNumbers& sensitivity) const;
  void check_block(References references, core::ValueType type, std::size_t size) const;
  std::size_t element_count(References references) const;

  ArgumentPlace place_;
  core::Unit* unit_ = nullptr;
  std::array<core::Capability*, core::kCapabilities> capabilities_{};
  bool checks_sizes_ = false;
  std::array<StepBuffers, KnownStepShapes::kMost> plans_;
  UnitTimes times_;
  bool is_in_step_ = false;
};

}  // namespace stride::isolation

#endif
