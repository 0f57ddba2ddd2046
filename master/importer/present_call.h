#ifndef STRIDE_MASTER_IMPORTER_PRESENT_CALL_H
#define STRIDE_MASTER_IMPORTER_PRESENT_CALL_H

#include <atomic>
#include <cstddef>
#include <optional>
#include <string_view>

#include "master/importer/call_note.h"
#include "master/model/description.h"
#include "master/util/error.h"
#include "master/util/fixed_text.h"

namespace stride::importer {

/// Its address identifies a thread.
inline thread_local char this_thread = 0;

/// The call of a function of an instance that has not returned, or whose values are still being
/// read from the memory of the unit. One thread makes calls; others, handlers of signals, and the
/// process that watches this one (core::Outliving) may look at any time. Nothing here allocates or
/// locks.
class PresentCall {
 public:
  static constexpr std::size_t kMostOutliving = 1024;

  /// The name of the unit and the file of its component are cut off if they are long. Each call is
  /// written to `note` as well, for another process; null = nowhere.
  PresentCall(std::string_view unit, const core::Location& where, CallNote* note)
      : unit_(unit), file_(where.file), line_(where.line), note_(note) {}

  /// `function` must outlive the call.
  void begin(const char* function, const std::optional<Time>& time) noexcept {
    thread_.store(&this_thread, std::memory_order_relaxed);
    time_ = time;
    function_.store(function, std::memory_order_relaxed);
    if (note_ != nullptr) [[unlikely]]
      note_->write(function, time.value_or(Time{}));
  }
  /// The value of which variable is read; must outlive the call.
  void read_value_of(const core::ValueReference* variable) noexcept {
    variable_.store(variable, std::memory_order_relaxed);
    if (note_ != nullptr) note_->write_variable(*variable);
  }
  void end() noexcept {
    function_.store(nullptr, std::memory_order_relaxed);
    if (note_ != nullptr) [[unlikely]]
      note_->clear();
  }
  void end_reading() noexcept {
    variable_.store(nullptr, std::memory_order_relaxed);
    end();
  }

  std::string_view unit() const noexcept { return unit_.view(); }
  /// The component's position in the scenario.
  std::string_view file() const noexcept { return file_.view(); }
  int line() const noexcept { return line_; }
  /// Of the last call.
  const std::optional<Time>& time() const noexcept { return time_; }
  /// Which thread makes it, or has made the last one: its address of this_thread.
  const char* thread() const noexcept { return thread_.load(std::memory_order_relaxed); }
  /// Null if there is no call.
  const char* function() const noexcept { return function_.load(std::memory_order_relaxed); }
  bool is_by_this_thread() const noexcept {
    return function() != nullptr && thread() == &this_thread;
  }
  /// Null if no value is being read.
  const core::ValueReference* variable() const noexcept {
    return variable_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<const char*> function_{nullptr};
  std::atomic<const char*> thread_{nullptr};
  std::optional<Time> time_;
  std::atomic<const core::ValueReference*> variable_{nullptr};
  const core::FixedText<128> unit_;
  const core::FixedText<256> file_;
  const int line_;
  CallNote* const note_;
};

}  // namespace stride::importer

#endif
