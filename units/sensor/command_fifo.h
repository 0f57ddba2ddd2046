// Commands on their way from the transceiver to the control unit.
#ifndef STRIDE_UNITS_SENSOR_COMMAND_FIFO_H
#define STRIDE_UNITS_SENSOR_COMMAND_FIFO_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <systemc>
#include <utility>

#include <stride/nfc/frame.h>
#include <stride/time.h>

namespace sensor {

/// A request that has been received without error.
struct ReceivedCommand {
  stride::Time received;      ///< the end of its frame
  stride::Time first_answer;  ///< when its answer may start at the earliest
  nfc::Bytes data;            ///< command byte and arguments, without CRC
};

/// Keeps the order of arrival. What does not fit is lost and counted.
class CommandFifo {
 public:
  explicit CommandFifo(std::size_t depth) : depth_(depth) {}

  void push(ReceivedCommand command) {
    if (commands_.size() == depth_) {
      ++overflows_;
      return;
    }
    commands_.push_back(std::move(command));
    written_.notify(sc_core::SC_ZERO_TIME);
  }

  /// There must be one.
  ReceivedCommand pop() {
    ReceivedCommand command = std::move(commands_.front());
    commands_.pop_front();
    return command;
  }

  void clear() { commands_.clear(); }
  bool empty() const { return commands_.empty(); }
  std::int32_t overflows() const { return overflows_; }
  const sc_core::sc_event& written() const { return written_; }

 private:
  std::size_t depth_;
  std::deque<ReceivedCommand> commands_;
  std::int32_t overflows_ = 0;
  sc_core::sc_event written_{"written"};
};

}  // namespace sensor

#endif
