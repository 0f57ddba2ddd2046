#ifndef STRIDE_MASTER_IMPORTER_CALL_NOTE_H
#define STRIDE_MASTER_IMPORTER_CALL_NOTE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <type_traits>

#include <stride/time.h>

namespace stride::importer {

/// Which function of a unit is being called, and at which simulated time. It outlives a crash of
/// the call, where its owner has put it into memory that outlives the process (isolation::Shared).
///
/// There are neither pointers nor locks in it, and nothing here allocates: it can be read by
/// another process, and by a signal handler. A reader beside the writer may see a name that is half
/// written, and never reads past the note's end.
class CallNote {
 public:
  static constexpr std::size_t kLongestName = 63;

  /// `function` is cut off after kLongestName characters.
  void write(const char* function, Time time = {}) noexcept {
    const std::size_t size = std::min(std::strlen(function), kLongestName);
    std::memcpy(name_.data(), function, size);
    name_[size] = '\0';
    time_ = time;
  }
  void clear() noexcept { name_[0] = '\0'; }

  /// Empty if no function is being called. Valid until the note is written again.
  std::string_view function() const noexcept {
    return {name_.data(), ::strnlen(name_.data(), kLongestName)};
  }
  /// Of the last call, whether it has returned or not.
  Time time() const noexcept { return time_; }

 private:
  std::array<char, kLongestName + 1> name_{};
  Time time_{};
};

static_assert(std::is_trivially_copyable_v<CallNote> && std::is_trivially_destructible_v<CallNote>);

}  // namespace stride::importer

#endif
