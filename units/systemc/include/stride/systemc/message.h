// Messages between clocked Binary variables and a module's FIFO ports or functions.
#ifndef STRIDE_SYSTEMC_MESSAGE_H
#define STRIDE_SYSTEMC_MESSAGE_H

#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <systemc>
#include <type_traits>
#include <utility>
#include <vector>

#include <stride/systemc/conversion.h>
#include <stride/systemc/elaboration.h>
#include <stride/systemc/kernel.h>
#include <stride/systemc/port.h>
#include <stride/unit.h>

namespace stride::systemc {

/// Messages that wait for their tick: a clock ticks once at a super-dense instant, so each further
/// message of the same instant, or of a step that could not stop early, takes one more.
class MessageOutput {
 public:
  MessageOutput(Binary& value, Clock& clock) : value_(value), clock_(clock) {}

  void push(Binary message) { waiting_.push_back(std::move(message)); }
  void clear() { waiting_.clear(); }
  bool empty() const { return waiting_.empty(); }

  /// Puts out the next message, if there is one, and ticks.
  void publish() {
    if (waiting_.empty()) return;
    value_ = std::move(waiting_.front());
    waiting_.pop_front();
    clock_.tick();
  }

 private:
  Binary& value_;
  Clock& clock_;
  std::deque<Binary> waiting_;
};

/// How the elements T of a FIFO are carried: encode() makes the message of one element, decode()
/// the elements of a message, and throws for bytes that are none. To be specialised for types of
/// your own.
template <class T, class = void>
struct Message {
  static_assert(detail::kNever<T>,
                "how does this type travel as bytes? Specialise stride::systemc::Message for it");
  static Binary encode(const T&) { return {}; }
  static std::vector<T> decode(const Binary&) { return {}; }
};

/// A whole message.
template <>
struct Message<Binary> {
  static const Binary& encode(const Binary& message) { return message; }
  static std::vector<Binary> decode(const Binary& message) { return {message}; }
};

/// Bytes: each that is written is a message, each of a message is read by itself.
template <class T>
struct Message<T, std::enable_if_t<std::is_integral_v<T> && sizeof(T) == 1>> {
  static Binary encode(T byte) { return {static_cast<std::uint8_t>(byte)}; }
  static std::vector<T> decode(const Binary& message) { return {message.begin(), message.end()}; }
};
template <>
struct Message<sc_dt::sc_uint<8>> {
  using Byte = sc_dt::sc_uint<8>;
  static Binary encode(const Byte& byte) { return {static_cast<std::uint8_t>(byte.to_uint())}; }
  static std::vector<Byte> decode(const Binary& message) {
    return {message.begin(), message.end()};
  }
};

/// To be called by a module when it sends: the clock ticks at this instant, if the master lets a
/// step end early, else where the step ends.
class Sender {
 public:
  explicit Sender(MessageOutput& output) : output_(&output) {}
  void operator()(Binary message) const {
    output_->push(std::move(message));
    sc_core::sc_pause();
  }

 private:
  MessageOutput* output_;
};

namespace detail {

template <class T>
using FifoIn = sc_core::sc_port_b<sc_core::sc_fifo_in_if<T>>;
template <class T>
using FifoOut = sc_core::sc_port_b<sc_core::sc_fifo_out_if<T>>;

enum class Direction { None, In, Out };
template <class T, Direction D>
struct Fifo {
  using Element = T;
  static constexpr Direction kDirection = D;
};
template <class T>
Fifo<T, Direction::In> fifo_of(FifoIn<T>&);
template <class T>
Fifo<T, Direction::Out> fifo_of(FifoOut<T>&);

/// Which FIFO port a target leads to, if any.
template <class Target, class Module, class = void>
struct FifoAt : Fifo<Binary, Direction::None> {};
template <class Target, class Module>
struct FifoAt<Target, Module,
              std::void_t<decltype(fifo_of(std::declval<Reached<Target, Module>>()))>>
    : decltype(fifo_of(std::declval<Reached<Target, Module>>())) {};

/// What an sc_fifo_out is bound to: it is never full, as what is written leaves the module at once.
template <class T>
class Outlet final : public sc_core::sc_prim_channel, public sc_core::sc_fifo_out_if<T> {
 public:
  explicit Outlet(Sender send)
      : sc_prim_channel(sc_core::sc_gen_unique_name("outlet")), send_(send) {}

  void write(const T& element) override { send_(Message<T>::encode(element)); }
  bool nb_write(const T& element) override { return write(element), true; }
  int num_free() const override { return std::numeric_limits<int>::max(); }
  const sc_core::sc_event& data_read_event() const override { return never_; }

 private:
  Sender send_;
  sc_core::sc_event never_{sc_core::sc_gen_unique_name("never")};
};

/// A pair of variables, NAME and the clock beside it.
class MessageRow {
 public:
  explicit MessageRow(std::string name) : name_(std::move(name)) {}
  virtual ~MessageRow() = default;
  MessageRow(const MessageRow&) = delete;
  MessageRow& operator=(const MessageRow&) = delete;

  Binary value;
  Clock clock;

  const std::string& name() const { return name_; }
  /// `receive.frame` has the clock `receive.clock`. Throws std::invalid_argument for a name without
  /// a dot.
  std::string clock_name() const;

  /// While the module is elaborated: binds its port, if it leads to one.
  virtual void connect(Elaboration& elaboration) = 0;
  /// Of an input: takes up the message if the clock has ticked. Returns how many elements were lost
  /// because the FIFO was full.
  virtual std::size_t receive() { return 0; }
  virtual void publish() {}
  virtual bool has_message() const { return false; }

 private:
  std::string name_;
};

template <class T>
class FifoInputRow final : public MessageRow {
 public:
  using Port = sc_core::sc_port_b<sc_core::sc_fifo_in_if<T>>;
  FifoInputRow(std::string name, std::function<Port&(sc_core::sc_module&)> find, int depth)
      : MessageRow(std::move(name)), find_(std::move(find)), depth_(depth) {}

  void connect(Elaboration& elaboration) override {
    Port& port = find_(elaboration.module());
    elaboration.take(port, name());
    auto fifo = std::make_unique<sc_core::sc_fifo<T>>(sc_core::sc_gen_unique_name("fifo"), depth_);
    fifo_ = fifo.get();
    elaboration.kernel().own(std::move(fifo));
    port.bind(*fifo_);
  }
  std::size_t receive() override {
    std::size_t lost = 0;
    if (!clock.ticked()) return lost;
    for (const T& element : Message<T>::decode(value)) lost += fifo_->nb_write(element) ? 0 : 1;
    return lost;
  }

 private:
  std::function<Port&(sc_core::sc_module&)> find_;
  int depth_;
  sc_core::sc_fifo<T>* fifo_ = nullptr;
};

class FunctionInputRow final : public MessageRow {
 public:
  using Take = std::function<void(sc_core::sc_module&, const Binary&)>;
  FunctionInputRow(std::string name, Take take)
      : MessageRow(std::move(name)), take_(std::move(take)) {}

  void connect(Elaboration& elaboration) override { module_ = &elaboration.module(); }
  std::size_t receive() override {
    if (clock.ticked()) take_(*module_, value);
    return 0;
  }

 private:
  Take take_;
  sc_core::sc_module* module_ = nullptr;
};

class MessageOutputRow final : public MessageRow {
 public:
  /// Binds a port, or hands the sender to the module.
  using Connect = std::function<void(Elaboration&, const Sender&)>;
  MessageOutputRow(std::string name, Connect connect)
      : MessageRow(std::move(name)), connect_(std::move(connect)) {}

  void connect(Elaboration& elaboration) override {
    output_.clear();
    connect_(elaboration, Sender(output_));
  }
  void publish() override { output_.publish(); }
  bool has_message() const override { return !output_.empty(); }

 private:
  Connect connect_;
  MessageOutput output_{value, clock};
};

}  // namespace detail
}  // namespace stride::systemc

#endif
