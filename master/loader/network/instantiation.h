#ifndef STRIDE_MASTER_LOADER_NETWORK_INSTANTIATION_H
#define STRIDE_MASTER_LOADER_NETWORK_INSTANTIATION_H

#include <cstdint>
#include <string>
#include <vector>

#include "master/loader/wire/codec.h"

namespace stride::remote {

/// What a unit on another machine is made of, as the master wants it.
struct Instantiation {
  std::string fmu;     ///< its path or name there; ignored if a file was sent
  std::string digest;  ///< of the description that the master has, so that both mean the same unit
  std::string name;    ///< of the component
  std::string file;    ///< the component's place in the scenario, for errors
  std::int32_t line = 0;
  bool early_return_allowed = false;
  bool intermediate_update = false;
  bool may_go_back = false;
  bool debug_logging = false;
  bool has_step = false;
  core::Interval step;  ///< of regular steps
  /// Sizes of arrays, given by structural parameters.
  std::vector<core::ValueReference> parameters;
  std::vector<std::uint64_t> elements;
  /// Whether its own functions for its state may be used.
  bool can_save_state = false;
  bool can_serialize_state = false;
  std::uint64_t call_limit = 0;    ///< [ms]; 0 = none
  std::uint64_t memory_limit = 0;  ///< [byte]; 0 = none
  bool is_sandboxed = true;
  bool takes_snapshots = false;

  void put(isolation::PacketWriter& to) const {
    visit(*this, [&]<class T>(const T& field) { isolation::Form<T>::put(to, field); });
  }
  static Instantiation take(isolation::PacketReader& from) {
    Instantiation taken;
    visit(taken, [&]<class T>(T& field) { field = isolation::Form<T>::take(from); });
    from.require_end();
    return taken;
  }

 private:
  /// Calls with(field) for each.
  static void visit(auto& of, auto&& with) {
    with(of.fmu), with(of.digest), with(of.name), with(of.file), with(of.line);
    with(of.early_return_allowed), with(of.intermediate_update), with(of.may_go_back);
    with(of.debug_logging), with(of.has_step), with(of.step), with(of.parameters);
    with(of.elements), with(of.can_save_state), with(of.can_serialize_state);
    with(of.call_limit), with(of.memory_limit), with(of.is_sandboxed), with(of.takes_snapshots);
  }
};

}  // namespace stride::remote

#endif
