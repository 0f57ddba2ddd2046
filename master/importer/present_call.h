#ifndef STRIDE_MASTER_IMPORTER_PRESENT_CALL_H
#define STRIDE_MASTER_IMPORTER_PRESENT_CALL_H

#include <atomic>

#include "master/importer/call_note.h"
#include "master/model/description.h"

namespace stride::importer {

/// Its address identifies a thread.
inline thread_local char this_thread = 0;

/// The call of a function of an instance that has not returned, or whose values are still being
/// read from the memory of the unit. One thread makes calls; others, and handlers of signals, may
/// look at any time. Nothing here allocates or locks.
class PresentCall {
 public:
  /// Each call is written to `note` as well, for another process; null = nowhere.
  explicit PresentCall(CallNote* note) : note_(note) {}

  /// `function` must outlive the call.
  void begin(const char* function, Time time) noexcept {
    thread_.store(&this_thread, std::memory_order_relaxed);
    function_.store(function, std::memory_order_relaxed);
    if (note_ != nullptr) [[unlikely]]
      note_->write(function, time);
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

  /// Null if there is no call.
  const char* function() const noexcept { return function_.load(std::memory_order_relaxed); }
  bool is_by_this_thread() const noexcept {
    return function() != nullptr && thread_.load(std::memory_order_relaxed) == &this_thread;
  }
  /// Null if no value is being read.
  const core::ValueReference* variable() const noexcept {
    return variable_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<const char*> function_{nullptr};
  std::atomic<const char*> thread_{nullptr};
  CallNote* const note_;
  std::atomic<const core::ValueReference*> variable_{nullptr};
};

}  // namespace stride::importer

#endif
