// Lists of living objects that a signal handler can read.
#ifndef STRIDE_MASTER_BASE_TEXT_LISTED_H
#define STRIDE_MASTER_BASE_TEXT_LISTED_H

#include <atomic>
#include <mutex>

namespace stride::core {

/// As a member of an object, declared last: it enters the object in the list of its class for as
/// long as it lives. Objects may come and go on any thread.
template <class T>
class Listed {
 public:
  explicit Listed(T& object) : object_(object) {
    const std::lock_guard lock(mutex_);
    next_ = first_.load();
    if (Listed* const next = next_) next->previous_ = this;
    first_ = this;
  }
  ~Listed() {
    const std::lock_guard lock(mutex_);
    (previous_ != nullptr ? previous_->next_ : first_) = next_.load();
    if (Listed* const next = next_) next->previous_ = previous_;
  }
  Listed(const Listed&) = delete;
  Listed& operator=(const Listed&) = delete;

  /// Calls visit(object) for each. Takes no lock and allocates nothing: for signal handlers and for
  /// the end of a process, where no object may come or go meanwhile.
  template <class Visit>
  static void for_each(Visit&& visit) {
    for (const Listed* at = first_; at != nullptr; at = at->next_) visit(at->object_);
  }

 private:
  static inline std::mutex mutex_;
  static inline std::atomic<Listed*> first_{nullptr};

  T& object_;
  std::atomic<Listed*> next_{nullptr};
  Listed* previous_ = nullptr;
};

}  // namespace stride::core

#endif
