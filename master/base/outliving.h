// Objects that can still be read when the process that has made them has ended, however it ended.
#ifndef STRIDE_MASTER_BASE_OUTLIVING_H
#define STRIDE_MASTER_BASE_OUTLIVING_H

#include <atomic>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "master/base/outliving_memory.h"
#include "master/base/robust_flag.h"

namespace stride::core {

/// Owns an object that a process which watches this one can read, and that is otherwise as one on
/// the heap: it is there where nobody watches, and where more than kMost objects live.
///
/// What T holds must make sense to another process: no memory of its own.
template <class T>
class Outliving {
 public:
  static constexpr std::size_t kMost = T::kMostOutliving;

  template <class... Arguments>
  explicit Outliving(Arguments&&... arguments) : slot_(take_slot()) {
    if (slot_ == nullptr) {
      own_ = std::make_unique<T>(std::forward<Arguments>(arguments)...);
      object_ = own_.get();
    } else {
      object_ = new (slot_->object) T(std::forward<Arguments>(arguments)...);
      slot_->is_used.set();
    }
  }
  ~Outliving() {
    if (slot_ == nullptr) return;
    slot_->is_used.set(false);
    slot_->is_taken = false;
  }
  Outliving(const Outliving&) = delete;
  Outliving& operator=(const Outliving&) = delete;

  T* operator->() { return object_; }
  const T* operator->() const { return object_; }
  T& operator*() { return *object_; }
  const T& operator*() const { return *object_; }

  /// Whether a process that watches this one can read it.
  bool is_shared() const { return slot_ != nullptr; }

  /// To be called before the process is forked that is watched. Throws std::bad_alloc.
  static void share() { slots_ = static_cast<Slot*>(OutlivingMemory::add(kMost * sizeof(Slot))); }

  /// For the watching process: calls visit(object) for those that were left. What the objects hold
  /// may be anything, if the process has damaged its memory.
  template <class Visit>
  static void for_each_left(Visit&& visit) {
    if (slots_ == nullptr) return;
    for (std::size_t i = 0; i < kMost; ++i) {
      if (slots_[i].is_used) visit(*std::launder(reinterpret_cast<T*>(slots_[i].object)));
    }
  }

  /// Likewise: the one that was left at this address, or null.
  static const T* left_at(const void* address) {
    const T* found = nullptr;
    for_each_left([&](const T& object) {
      if (&object == address) found = &object;
    });
    return found;
  }

 private:
  static_assert(std::is_trivially_destructible_v<T>);

  struct Slot {
    std::atomic<bool> is_taken;
    RobustFlag is_used;
    alignas(T) unsigned char object[sizeof(T)];
  };

  static Slot* take_slot() {
    if (slots_ == nullptr || !OutlivingMemory::is_shared()) return nullptr;
    for (std::size_t i = 0; i < kMost; ++i) {
      if (!slots_[i].is_taken.exchange(true)) return &slots_[i];
    }
    return nullptr;
  }

  static inline Slot* slots_ = nullptr;

  Slot* slot_;
  std::unique_ptr<T> own_;
  T* object_;
};

}  // namespace stride::core

#endif
