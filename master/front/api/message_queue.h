// The messages that a caller has not looked at yet.
#ifndef STRIDE_MASTER_FRONT_API_MESSAGE_QUEUE_H
#define STRIDE_MASTER_FRONT_API_MESSAGE_QUEUE_H

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "master/engine/model/system/system.h"
#include "master/engine/model/values.h"
#include "master/engine/port/observer.h"

namespace stride::api {

class MessageQueue final : public core::Observer {
 public:
  struct Entry {
    Time time;
    std::uint32_t index = 0;  ///< the super-dense one
    core::VariableId id;
    bool is_received = false;
    std::optional<core::ValueBlock> value;
    std::string content;
    std::size_t dropped = 0;  ///< messages before it
  };

  /// The system must outlive it. `limit`: how many are kept; older ones are dropped.
  MessageQueue(const core::System& system, std::size_t limit) : system_(system), limit_(limit) {}

  bool wants_content() const override { return true; }
  void on_message(const core::Message& message) override;

  /// The oldest one, if there is one.
  std::optional<Entry> take();

 private:
  const core::System& system_;
  std::size_t limit_;
  std::deque<Entry> entries_;
  std::size_t dropped_ = 0;  ///< before the first one of these
};

}  // namespace stride::api

#endif
