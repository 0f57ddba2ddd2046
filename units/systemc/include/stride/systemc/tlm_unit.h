// A module with sockets of TLM-2.0 as a unit.
//
//   class Timer : public stride::systemc::TlmUnit<TimerModule> {
//    public:
//     Timer() : TlmUnit("timer", "A timer behind a bus") {
//       registers("bus", &TimerModule::socket,
//                 {{"load", 0x0, Access::Write}, {"count", 0x4}, {"status", 0x8}});
//     }
//   };
//   STRIDE_UNIT(Timer)
#ifndef STRIDE_SYSTEMC_TLM_UNIT_H
#define STRIDE_SYSTEMC_TLM_UNIT_H

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <stride/systemc/module_unit.h>
#include <stride/systemc/tlm_rows.h>

namespace stride::systemc {

/// A ModuleUnit with rows for sockets. Each socket of the module has one of these rows. Sockets are
/// those of the base protocol, of any width: tlm_target_socket, simple_target_socket,
/// multi_passthrough_initiator_socket and all others.
template <class Module>
class TlmUnit : public ModuleUnit<Module> {
 protected:
  using ModuleUnit<Module>::ModuleUnit;

  /// Registers behind a target socket: the variables NAME.REGISTER, outputs for those that are read
  /// and inputs for those that are written. A register is read with transport_dbg(), which costs no
  /// time, at each communication point; it is written with b_transport() where its variable
  /// changes, and where the run begins if it is not 0, one after the other, each with its delay.
  /// Numbers are in the order of bytes of this machine, as TLM has them.
  template <class Target>
  void registers(const std::string& name, Target target, const std::vector<Register>& list) {
    detail::InitiatorRow& bus = add_initiator(name, std::move(target));
    for (const Register& entry : list) {
      detail::with_type_of(entry, [&](auto zero) {
        using T = decltype(zero);
        if (entry.access == Access::Write) {
          auto row =
              std::make_unique<detail::RegisterInputRow<T>>(name + '.' + entry.name, entry, bus);
          this->Unit::input(row->name(), row->value);
          this->add_row(std::move(row));
        } else {
          auto row =
              std::make_unique<detail::RegisterOutputRow<T>>(name + '.' + entry.name, entry, bus);
          this->Unit::output(row->name(), row->value);
          this->add_row(std::move(row));
        }
      });
    }
  }

  /// Transactions as messages, see Transaction. Of a target socket: what comes in NAME.request.data
  /// is transported, one after the other, each at the earliest where it arrives; NAME.response.data
  /// is sent where it has ended. Of an initiator socket: NAME.request.data is sent where a
  /// transaction begins, which ends where NAME.response.data comes; responses come in the order of
  /// the requests.
  template <class Target>
  void transactions(const std::string& name, Target target) {
    if constexpr (detail::kIsTargetSocket<Target, Module>) {
      detail::InitiatorRow& bus = add_initiator(name, std::move(target));
      auto sender = std::make_shared<std::optional<Sender>>();
      this->message_input(name + ".request.data", [&bus, sender](Module&, const Binary& request) {
        bus.post(decode_transaction(request),
                 [sender](const Transaction& done) { (**sender)(encode(done)); });
      });
      this->message_output(name + ".response.data",
                           [sender](Module&, Sender send) { sender->emplace(send); });
    } else {
      auto row = std::make_unique<detail::TargetRow>(name, connect_target(std::move(target)),
                                                     std::make_unique<detail::RemoteTarget>());
      auto& remote = static_cast<detail::RemoteTarget&>(row->target());
      this->add_row(std::move(row));
      this->message_output(name + ".request.data",
                           [&remote](Module&, Sender send) { remote.set_sender(send); });
      this->message_input(name + ".response.data", [&remote](Module&, const Binary& response) {
        remote.respond(decode_transaction(response));
      });
    }
  }

  /// An initiator socket reads and writes these bytes, from address 0 on, which begin with
  /// `content` at each start; each transaction takes `latency`. What is beyond them is an address
  /// error, which takes no time. All of it may be accessed directly (DMI), with the same latency.
  template <class Target>
  void memory(const std::string& name, Target target, std::size_t size, Duration latency = {},
              Binary content = {}) {
    content.resize(std::max(size, content.size()));
    this->add_row(std::make_unique<detail::TargetRow>(
        name, connect_target(std::move(target)),
        std::make_unique<detail::MemoryTarget>(std::move(content), latency)));
  }

  /// Temporal decoupling: an initiator that asks for the global quantum may run ahead of SystemC's
  /// time by this, but never beyond the end of a step. Without it initiators do not run ahead,
  /// unless the module sets the global quantum itself, and then they may do so beyond the end of a
  /// step.
  void quantum(Duration longest) { quantum_ = longest; }

  void begin_step(const Step& step) override {
    ModuleUnit<Module>::begin_step(step);
    if (quantum_ > Duration{}) {
      this->kernel().set_quantum(detail::quantum_within(
          this->to_device(step.from()).time_since_epoch(), step.size(), quantum_));
    }
  }

 private:
  template <class Target>
  detail::InitiatorRow& add_initiator(const std::string& name, Target target) {
    static_assert(detail::kIsTargetSocket<Target, Module>,
                  "this row needs a target socket of TLM-2.0, of the base protocol");
    auto row = std::make_unique<detail::InitiatorRow>(
        name, [target](detail::Elaboration& elaboration, const std::string& row_name) {
          auto& socket = std::invoke(target, static_cast<Module&>(elaboration.module()));
          elaboration.take(socket, row_name);
          using Outer = detail::InitiatorSocket<decltype(detail::width_of(socket))::value>;
          auto outer = std::make_shared<Outer>(sc_core::sc_gen_unique_name("initiator"));
          outer->socket.bind(socket);
          elaboration.kernel().own(outer);
          return outer->port();
        });
    detail::InitiatorRow& bus = *row;
    this->add_row(std::move(row));
    return bus;
  }
  template <class Target>
  detail::TargetRow::Connect connect_target(Target target) {
    static_assert(detail::kIsInitiatorSocket<Target, Module>,
                  "this row needs a socket of TLM-2.0, of the base protocol: memory() an initiator "
                  "socket, transactions() that or a target socket");
    return [target](detail::Elaboration& elaboration, const std::string& row_name,
                    detail::TransactionTarget& inner) {
      auto& socket = std::invoke(target, static_cast<Module&>(elaboration.module()));
      elaboration.take(socket, row_name);
      using Outer = detail::TargetSocket<decltype(detail::width_of(socket))::value>;
      auto outer = std::make_shared<Outer>(sc_core::sc_gen_unique_name("target"), inner);
      socket.bind(outer->socket);
      elaboration.kernel().own(outer);
    };
  }

  Duration quantum_{};
};

}  // namespace stride::systemc

#endif
