#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_PRESENT_CALL_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_PRESENT_CALL_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "master/base/error.h"
#include "master/base/outliving.h"
#include "master/base/text/fixed_text.h"
#include "master/engine/model/description.h"
#include "master/loader/fmu/instance/call_note.h"

namespace stride::importer {

/// Its address identifies a thread. Both are in the program itself: no library has them, so they
/// need no look-up.
[[gnu::tls_model("initial-exec")]] inline thread_local char this_thread = 0;

/// The PresentCall or RowCall that this thread has begun last; its object may be gone.
[[gnu::tls_model("initial-exec")]] inline thread_local const void* last_call_of_thread = nullptr;

/// What the process that watches this one sees of a call: see core::Outliving. What each call
/// writes is in one cache line.
struct alignas(64) LeftCall {
  static constexpr std::size_t kMostOutliving = 1024;

  /// The name of the unit and the file of its component are cut off if they are long.
  LeftCall(std::string_view unit_name, const core::Location& where)
      : unit(unit_name), file(where.file), line(where.line) {}

  std::atomic<const char*> function{nullptr};  ///< of the last call; null if there was none
  std::atomic<const char*> thread{nullptr};    ///< which makes it: its address of this_thread
  Time time{};
  /// Whose call it is, if it is the one of a row that this belongs to (RowCall); null = its own.
  std::atomic<const LeftCall*> member{nullptr};
  std::atomic<bool> is_unfinished{false};
  bool has_time = false;
  const core::FixedText<128> unit;
  const core::FixedText<256> file;  ///< with `line`, the component's position in the scenario
  const int line;
};

class PresentCall;

/// The present call of instances that step in a row. What is the same for all of them, and for all
/// calls of one, is noted once; each instance refers to it (PresentCall::set_row) as long as it
/// lives. Sequences of calls by themselves must not be begun meanwhile.
///
/// To other processes it is the call of one of the instances, which says whose it is.
class RowCall {
 public:
  /// Of one instance at least, none of which has a note; they must outlive this object.
  explicit RowCall(std::span<PresentCall* const> members);

  /// Of the first calls of a row, which are those of this instance.
  [[gnu::always_inline]] void begin(const PresentCall& member, const LeftCall& left,
                                    Time time) noexcept {
    last_call_of_thread = this;
    thread_.store(&this_thread, std::memory_order_relaxed);
    left_->thread.store(&this_thread, std::memory_order_relaxed);
    left_->has_time = true;
    begin_member(member, left, time);
    is_active_.store(true, std::memory_order_relaxed);
    left_->is_unfinished.store(true, std::memory_order_relaxed);
  }
  /// The next calls are those of this instance; `left`: its own.
  [[gnu::always_inline]] void begin_member(const PresentCall& member, const LeftCall& left,
                                           Time time) noexcept {
    member_.store(&member, std::memory_order_relaxed);
    left_->member.store(&left, std::memory_order_relaxed);
    left_->time = time;
  }
  [[gnu::always_inline]] void set_time(Time time) noexcept { left_->time = time; }
  [[gnu::always_inline]] void begin_next(const char* function) noexcept {
    left_->function.store(function, std::memory_order_relaxed);
  }
  [[gnu::always_inline]] void end() noexcept {
    is_active_.store(false, std::memory_order_relaxed);
    left_->is_unfinished.store(false, std::memory_order_relaxed);
    left_->member.store(nullptr, std::memory_order_relaxed);
  }

  /// Whether calls of this instance are made.
  bool is_of(const PresentCall& member) const noexcept {
    return is_active_.load(std::memory_order_relaxed) && was_last_of(member);
  }
  /// Whether the last call was one of this instance.
  bool was_last_of(const PresentCall& member) const noexcept {
    return member_.load(std::memory_order_relaxed) == &member;
  }
  const char* thread() const noexcept { return thread_.load(std::memory_order_relaxed); }
  const char* function() const noexcept { return left_->function.load(std::memory_order_relaxed); }
  Time time() const noexcept { return left_->time; }

 private:
  std::atomic<const PresentCall*> member_{nullptr};
  std::atomic<bool> is_active_{false};
  std::atomic<const char*> thread_{nullptr};
  LeftCall* left_;
};

/// The call of a function of an instance that has not returned, or whose values are still being
/// read from the memory of the unit. One thread makes calls; others, handlers of signals, and the
/// process that watches this one may look at any time. Nothing here allocates or locks.
///
/// Calls that a thread makes one after the other are a sequence: the first of them notes what is
/// the same for all, and each notes its function, which stays noted until the next one begins.
///
/// A copy of the process, which the function may make, knows for itself whether there is a call,
/// and of which thread. Its function is the one that the first process has called last.
class PresentCall {
 public:
  /// Each call is written to `note` as well, for another process; null = nowhere.
  PresentCall(std::string_view unit, const core::Location& where, CallNote* note)
      : left_(unit, where), note_(note) {}

  /// `function` must outlive the call. Within a sequence the call is one of it.
  [[gnu::always_inline]] void begin(const char* function,
                                    const std::optional<Time>& time) noexcept {
    left_->has_time = time.has_value();  // not as a whole, which would wait for its last change
    begin_any(time.value_or(Time{}),
              extent() == Extent::Sequence ? Extent::Sequence : Extent::Call);
    begin_next(function);
  }
  /// Before calls with a time.
  [[gnu::always_inline]] void begin_sequence(Time time) noexcept {
    begin_any(time, Extent::Sequence);
  }
  /// Another time than that of the sequence from here on.
  [[gnu::always_inline]] void set_time(Time time) noexcept { left_->time = time; }
  /// One of a sequence; no end() is needed between them.
  [[gnu::always_inline]] void begin_next(const char* function) noexcept {
    left_->function.store(function, std::memory_order_relaxed);
    if (note_ != nullptr) [[unlikely]]
      note_->write(function, left_->time);
  }
  bool has_note() const noexcept { return note_ != nullptr; }
  /// The value of which variable is read; must outlive the call.
  void read_value_of(const core::ValueReference* variable) noexcept {
    variable_.store(variable, std::memory_order_relaxed);
    if (note_ != nullptr) note_->write_variable(*variable);
  }
  /// Within a sequence only the other process forgets the call.
  [[gnu::always_inline]] void end() noexcept {
    if (!is_in_sequence()) return end_sequence();
    if (note_ != nullptr) note_->clear();
  }
  [[gnu::always_inline]] void end_sequence() noexcept {
    extent_.store(Extent::None, std::memory_order_relaxed);
    left_->is_unfinished.store(false, std::memory_order_relaxed);
    if (note_ != nullptr) [[unlikely]]
      note_->clear();
  }
  void end_reading() noexcept {
    variable_.store(nullptr, std::memory_order_relaxed);
    end();
  }

  /// From now on it may be one of this row; null: of none.
  void set_row(const RowCall* row) noexcept { row_ = row; }
  bool is_in_row() const noexcept { return row_ != nullptr && row_->is_of(*this); }

  bool is_in_sequence() const noexcept { return extent() == Extent::Sequence || is_in_row(); }
  /// Which thread makes it, or has made the last one: its address of this_thread.
  const char* thread() const noexcept {
    return is_in_row() ? row_->thread() : thread_.load(std::memory_order_relaxed);
  }
  /// Null if there is no call.
  const char* function() const noexcept {
    if (is_in_row()) return row_->function();
    return extent() != Extent::None ? last_function() : nullptr;
  }
  bool is_by_this_thread() const noexcept {
    return function() != nullptr && thread() == &this_thread;
  }
  /// The function of the last call of all that this thread has made; null if it is no call of this
  /// object.
  const char* last_function_of_thread() const noexcept {
    if (last_call_of_thread == this) return last_function();
    const bool is_of_row =
        row_ != nullptr && last_call_of_thread == row_ && row_->was_last_of(*this);
    return is_of_row ? row_->function() : nullptr;
  }
  LeftCall& left() noexcept { return *left_; }
  /// Whether left_calls() finds it.
  bool can_be_left() const noexcept { return left_.is_shared(); }
  /// Null if no value is being read.
  const core::ValueReference* variable() const noexcept {
    return variable_.load(std::memory_order_relaxed);
  }

 private:
  enum class Extent : std::uint8_t { None, Call, Sequence };

  [[gnu::always_inline]] void begin_any(Time time, Extent extent) noexcept {
    LeftCall& left = *left_;
    last_call_of_thread = this;
    const char* const thread = &this_thread;
    thread_.store(thread, std::memory_order_relaxed);
    extent_.store(extent, std::memory_order_relaxed);
    left.thread.store(thread, std::memory_order_relaxed);
    left.time = time;
    left.is_unfinished.store(true, std::memory_order_relaxed);
  }
  Extent extent() const noexcept { return extent_.load(std::memory_order_relaxed); }
  const char* last_function() const noexcept {
    return left_->function.load(std::memory_order_relaxed);
  }

  std::atomic<Extent> extent_{Extent::None};
  std::atomic<const char*> thread_{nullptr};
  core::Outliving<LeftCall> left_;
  CallNote* const note_;
  std::atomic<const core::ValueReference*> variable_{nullptr};
  const RowCall* row_ = nullptr;
};

inline RowCall::RowCall(std::span<PresentCall* const> members) : left_(&members.front()->left()) {
  for (PresentCall* const member : members) {
    if (!member->can_be_left()) continue;
    left_ = &member->left();
    return;
  }
}

}  // namespace stride::importer

#endif
