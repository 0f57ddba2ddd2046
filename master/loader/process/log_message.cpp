#include "master/loader/process/log_message.h"

#include <chrono>
#include <cstring>
#include <thread>

namespace stride::isolation {
namespace {

struct Head {
  std::uint32_t status, category_size;
  std::uint64_t text_size;
};

/// Of either text. The reader keeps a message until it is whole, so there has to be an end.
constexpr std::size_t kLongest = std::size_t{64} << 20;

}  // namespace

void LogWriter::write(const LogMessage& message) {
  const auto category = std::string_view(message.category).substr(0, kLongest);
  const auto text = std::string_view(message.text).substr(0, kLongest);
  const Head head{static_cast<std::uint32_t>(message.status),
                  static_cast<std::uint32_t>(category.size()), text.size()};
  const std::lock_guard lock(mutex_);
  write({reinterpret_cast<const char*>(&head), sizeof head});
  write(category);
  write(text);
}

void LogWriter::write(std::string_view bytes) {
  for (;;) {
    bytes.remove_prefix(link_.logged.write(bytes));
    if (bytes.empty()) return;
    link_.reply.doorbell.ring();
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
}

bool LogReader::next(LogMessage& message) {
  Head head{};
  if (bytes_.size() < sizeof head) return false;
  std::memcpy(&head, bytes_.data(), sizeof head);
  if (head.category_size > kLongest || head.text_size > kLongest) {  // nothing can follow these
    bytes_.clear();
    return false;
  }
  const std::size_t rest = bytes_.size() - sizeof head;
  if (rest < head.category_size || rest - head.category_size < head.text_size) return false;
  const auto last = static_cast<std::uint32_t>(importer::Status::Pending);
  message.status =
      head.status <= last ? static_cast<importer::Status>(head.status) : importer::Status::Error;
  message.category = bytes_.substr(sizeof head, head.category_size);
  message.text = bytes_.substr(sizeof head + head.category_size, head.text_size);
  bytes_.erase(0, sizeof head + head.category_size + head.text_size);
  return true;
}

}  // namespace stride::isolation
