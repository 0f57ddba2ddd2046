// The rows of a TlmUnit, and what is behind them: initiators and targets of TLM-2.0.
#ifndef STRIDE_SYSTEMC_TLM_ROWS_H
#define STRIDE_SYSTEMC_TLM_ROWS_H

#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <systemc>
#include <tlm>
#include <type_traits>
#include <utility>

#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <stride/systemc/message.h>
#include <stride/systemc/row.h>
#include <stride/systemc/transaction.h>

namespace stride::systemc {

enum class Access { Read, Write };

/// Of 1, 2, 4 or 8 bytes: a variable of the type UInt8 to UInt64. One that is both read and written
/// is listed twice, under two names.
struct Register {
  std::string name;
  std::uint64_t address;
  Access access = Access::Read;
  unsigned bytes = 4;
};

namespace detail {

// The sockets of the module.

template <unsigned Width, class Forward, class Backward>
std::integral_constant<unsigned, Width> width_of(
    tlm::tlm_base_target_socket_b<Width, Forward, Backward>&);
template <unsigned Width, class Forward, class Backward>
std::integral_constant<unsigned, Width> width_of(
    tlm::tlm_base_initiator_socket_b<Width, Forward, Backward>&);

template <unsigned Width>
std::true_type is_target(
    tlm::tlm_base_target_socket_b<Width, tlm::tlm_fw_transport_if<>, tlm::tlm_bw_transport_if<>>*);
std::false_type is_target(void*);
template <unsigned Width>
std::true_type is_initiator(tlm::tlm_base_initiator_socket_b<Width, tlm::tlm_fw_transport_if<>,
                                                             tlm::tlm_bw_transport_if<>>*);
std::false_type is_initiator(void*);

template <class Target, class Module>
inline constexpr bool kIsTargetSocket =
    decltype(is_target(std::declval<std::remove_reference_t<Reached<Target, Module>>*>()))::value;
template <class Target, class Module>
inline constexpr bool kIsInitiatorSocket = decltype(is_initiator(
    std::declval<std::remove_reference_t<Reached<Target, Module>>*>()))::value;

// The sockets on the other side.

template <unsigned Width>
class InitiatorSocket : public sc_core::sc_module {
 public:
  tlm_utils::simple_initiator_socket<InitiatorSocket, Width> socket{"socket"};
  explicit InitiatorSocket(sc_core::sc_module_name name) : sc_module(name) {}
  /// The target, once it is bound.
  std::function<tlm::tlm_fw_transport_if<>&()> port() {
    return [this]() -> tlm::tlm_fw_transport_if<>& { return *socket.operator->(); };
  }
};

/// What a target does with transactions.
class TransactionTarget {
 public:
  virtual ~TransactionTarget() = default;
  /// While a module is elaborated.
  virtual void reset() = 0;
  virtual void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) = 0;
  /// Without any effect but on what is read or written; returns how many bytes were.
  virtual unsigned debug(tlm::tlm_generic_payload& payload) = 0;
  /// What may be accessed without transactions; returns whether there is such memory.
  virtual bool direct(tlm::tlm_dmi& /*access*/) { return false; }
};

/// tlm_utils translates what initiators do with nb_transport.
template <unsigned Width>
class TargetSocket : public sc_core::sc_module {
 public:
  tlm_utils::simple_target_socket<TargetSocket, Width> socket{"socket"};
  TargetSocket(sc_core::sc_module_name name, TransactionTarget& target)
      : sc_module(name), target_(target) {
    socket.register_b_transport(this, &TargetSocket::transport);
    socket.register_transport_dbg(this, &TargetSocket::debug);
    socket.register_get_direct_mem_ptr(this, &TargetSocket::direct);
  }

 private:
  void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
    target_.transport(payload, delay);
  }
  unsigned debug(tlm::tlm_generic_payload& payload) { return target_.debug(payload); }
  bool direct(tlm::tlm_generic_payload& /*payload*/, tlm::tlm_dmi& access) {
    return target_.direct(access);
  }
  TransactionTarget& target_;
};

/// So many bytes that the unit holds. What it refuses takes no time.
class MemoryTarget final : public TransactionTarget {
 public:
  MemoryTarget(Binary content, Duration latency)
      : content_(std::move(content)), latency_(latency) {}
  void reset() override { bytes_ = content_; }
  void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override;
  unsigned debug(tlm::tlm_generic_payload& payload) override;
  bool direct(tlm::tlm_dmi& access) override;

 private:
  Binary content_;
  Duration latency_;
  Binary bytes_;
};

/// Another unit, by messages.
class RemoteTarget final : public TransactionTarget {
 public:
  void reset() override;
  void set_sender(Sender send) { send_.emplace(send); }
  void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) override;
  unsigned debug(tlm::tlm_generic_payload& /*payload*/) override { return 0; }
  /// Ends the oldest transaction. Throws std::invalid_argument if there is none.
  void respond(Transaction response);

 private:
  struct Pending {
    std::optional<Transaction> response;
    sc_core::sc_event done{sc_core::sc_gen_unique_name("response")};
  };
  std::optional<Sender> send_;
  std::deque<Pending*> pending_;  ///< on the stacks of the processes that wait
};

// The rows.

/// Sends transactions to a target socket, one after the other.
class InitiatorRow final : public Row {
 public:
  using Port = std::function<tlm::tlm_fw_transport_if<>&()>;
  using Connect = std::function<Port(Elaboration&, const std::string& row)>;
  using Done = std::function<void(const Transaction&)>;

  InitiatorRow(std::string name, Connect connect)
      : Row(std::move(name)), connect_(std::move(connect)) {}

  void connect(Elaboration& elaboration) override;
  /// `done`, in the process that has sent it, gets the response.
  void post(Transaction request, Done done);
  /// With transport_dbg(). Throws std::runtime_error if the target does not give all of it.
  Binary peek(const Register& place, const std::string& variable);

 private:
  struct Job {
    Transaction transaction;
    Done done;
  };
  void serve();
  void perform(Job& job);

  Connect connect_;
  Port port_;
  std::deque<Job> jobs_;
  sc_core::sc_event* posted_ = nullptr;  ///< the kernel's, and destroyed with it
};

/// Throws std::runtime_error unless the response is Status::Ok.
void require_ok(const Transaction& response, const std::string& variable);

template <class T>
class RegisterInputRow final : public Row {
 public:
  T value{};
  RegisterInputRow(std::string name, Register place, InitiatorRow& bus)
      : Row(std::move(name)), place_(std::move(place)), bus_(bus) {}

  void connect(Elaboration& /*elaboration*/) override { written_ = 0; }
  bool write() override {
    if (value == written_) return false;
    written_ = value;
    Binary data(sizeof(T));
    std::memcpy(data.data(), &value, sizeof(T));
    bus_.post({Transaction::Command::Write, Transaction::Status::Incomplete, place_.address,
               sizeof(T), std::move(data)},
              [variable = name()](const Transaction& response) { require_ok(response, variable); });
    return true;
  }

 private:
  Register place_;
  InitiatorRow& bus_;
  T written_{};
};

template <class T>
class RegisterOutputRow final : public Row {
 public:
  T value{};
  RegisterOutputRow(std::string name, Register place, InitiatorRow& bus)
      : Row(std::move(name)), place_(std::move(place)), bus_(bus) {}

  void connect(Elaboration& /*elaboration*/) override {}
  void read() override { std::memcpy(&value, bus_.peek(place_, name()).data(), sizeof(T)); }

 private:
  Register place_;
  InitiatorRow& bus_;
};

/// Answers an initiator socket.
class TargetRow final : public Row {
 public:
  using Connect =
      std::function<void(Elaboration&, const std::string& row, TransactionTarget& target)>;
  TargetRow(std::string name, Connect connect, std::unique_ptr<TransactionTarget> target)
      : Row(std::move(name)), connect_(std::move(connect)), target_(std::move(target)) {}

  void connect(Elaboration& elaboration) override {
    target_->reset();
    connect_(elaboration, name(), *target_);
  }
  TransactionTarget& target() { return *target_; }

 private:
  Connect connect_;
  std::unique_ptr<TransactionTarget> target_;
};

/// Calls f with 0 of the register's type. Throws std::invalid_argument for a size that none has.
template <class Function>
void with_type_of(const Register& place, Function&& f) {
  switch (place.bytes) {
    case 1:
      return f(std::uint8_t{});
    case 2:
      return f(std::uint16_t{});
    case 4:
      return f(std::uint32_t{});
    case 8:
      return f(std::uint64_t{});
    default:
      throw std::invalid_argument("the register " + place.name + " has " +
                                  std::to_string(place.bytes) +
                                  " bytes; 1, 2, 4 or 8 are possible");
  }
}

/// The longest quantum, up to `longest`, that divides both the instant at which a step begins and
/// its size: whole quanta, which initiators count from 0 s, so end where the step does.
Duration quantum_within(Duration from, Duration size, Duration longest);

}  // namespace detail
}  // namespace stride::systemc

#endif
