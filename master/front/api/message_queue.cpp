#include "master/front/api/message_queue.h"

#include <utility>

namespace stride::api {

void MessageQueue::on_message(const core::Message& message) {
  Entry entry{.time = message.time,
              .index = message.index,
              .id = message.id,
              .is_received = message.received,
              .value = {},
              .content = std::string(message.content)};
  if (message.block != nullptr) {
    const core::Variable& variable = system_.variable(message.id);
    entry.value.emplace(variable.type, variable.size);
    core::copy_elements(*entry.value, 0, *message.block, message.first, variable.size);
  }
  if (entries_.size() == limit_) {
    ++dropped_;
    entries_.pop_front();
  }
  entries_.push_back(std::move(entry));
}

std::optional<MessageQueue::Entry> MessageQueue::take() {
  if (entries_.empty()) return std::nullopt;
  Entry entry = std::move(entries_.front());
  entries_.pop_front();
  entry.dropped = std::exchange(dropped_, 0);
  return entry;
}

}  // namespace stride::api
