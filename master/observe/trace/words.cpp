#include "master/observe/trace/words.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace stride::trace {
namespace {

/// Space, and tab to carriage return. Not NUL: a crashed machine leaves those behind what is good.
constexpr bool is_blank(char c) {
  return c == ' ' || static_cast<unsigned char>(c - '\t') <= '\r' - '\t';
}

}  // namespace

Words::Words(std::filesystem::path path)
    : path_(std::move(path)), buffer_(std::make_unique<char[]>(kPiece)) {
  descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) {
    fail(0, fmt::format("cannot open the file: {}", std::generic_category().message(errno)));
  }
}

Words::~Words() { ::close(descriptor_); }

core::Context Words::at(std::int64_t line) const {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  return {.where = {path_.string(), static_cast<int>(std::min(line, kMost))}};
}

void Words::fail(std::int64_t line, const std::string& message, const std::string& hint) const {
  core::fail_input(at(line), message, hint);
}

std::string Words::shown(std::string_view word) {
  constexpr std::size_t kMost = 40;
  std::string text;
  for (const char c : word.substr(0, kMost)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte > ' ' && byte < 127) {
      text += c;
    } else {
      text += fmt::format("\\x{:02x}", byte);
    }
  }
  return word.size() > kMost ? text + "…" : text;
}

bool Words::refill(std::size_t& from) {
  if (at_end_) return false;
  const std::size_t kept = end_ - from;
  if (kept == capacity_) {
    if (kept >= kLongest) {
      fail(line_, fmt::format("'{}' is longer than any word of a value change dump",
                              shown({buffer_.get() + from, kept})));
    }
    auto larger = std::make_unique<char[]>(2 * capacity_);
    std::memcpy(larger.get(), buffer_.get() + from, kept);
    buffer_ = std::move(larger);
    capacity_ *= 2;
  } else {
    std::memmove(buffer_.get(), buffer_.get() + from, kept);
  }
  from = 0;
  end_ = kept;
  ssize_t count = 0;
  do {
    count = ::read(descriptor_, buffer_.get() + end_, capacity_ - end_);
  } while (count < 0 && errno == EINTR);
  if (count < 0) {
    fail(0, fmt::format("cannot read the file: {}", std::generic_category().message(errno)));
  }
  at_end_ = count == 0;
  end_ += static_cast<std::size_t>(count);
  bytes_read_ += static_cast<std::uint64_t>(count);
  return !at_end_;
}

void Words::skip_blanks() {
  while (true) {
    const std::size_t from = at_;
    for (; at_ < end_ && is_blank(buffer_[at_]); ++at_) line_ += buffer_[at_] == '\n';
    if (record_ != nullptr) record_->append(buffer_.get() + from, at_ - from);
    if (at_ < end_ || !refill(at_)) return;
  }
}

std::string_view Words::next() {
  skip_blanks();
  std::size_t first = at_;
  while (true) {
    while (at_ < end_ && !is_blank(buffer_[at_])) ++at_;
    if (at_ < end_) break;
    const std::size_t length = at_ - first;
    const bool has_more = refill(first);
    at_ = first + length;
    if (!has_more) break;
  }
  const std::string_view word(buffer_.get() + first, at_ - first);
  if (record_ != nullptr) record_->append(word);
  return word;
}

}  // namespace stride::trace
