#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_CALL_NOTE_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_CALL_NOTE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
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
    has_variable_ = 0;
  }
  /// The value of which variable is read that the function has given, by its reference.
  void write_variable(std::uint32_t reference) noexcept {
    variable_ = reference;
    has_variable_ = 1;
  }
  void clear() noexcept {
    name_[0] = '\0';
    has_variable_ = 0;
  }

  /// Empty if no function is being called. Valid until the note is written again.
  std::string_view function() const noexcept {
    return {name_.data(), ::strnlen(name_.data(), kLongestName)};
  }
  /// Of the last call, whether it has returned or not.
  Time time() const noexcept { return time_; }
  /// Nothing if no value is being read.
  std::optional<std::uint32_t> variable() const noexcept {
    return has_variable_ != 0 ? std::optional(variable_) : std::nullopt;
  }

 private:
  std::array<char, kLongestName + 1> name_{};
  Time time_{};
  std::uint32_t variable_ = 0;
  std::uint8_t has_variable_ = 0;  ///< no bool, since another process may write any byte
};

static_assert(std::is_trivially_copyable_v<CallNote> && std::is_trivially_destructible_v<CallNote>);

}  // namespace stride::importer

#endif
