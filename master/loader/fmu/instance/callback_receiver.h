// To which instance a callback of a unit belongs.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_CALLBACK_RECEIVER_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_CALLBACK_RECEIVER_H

#include <mutex>
#include <set>

namespace stride::importer {

/// An instance, as its unit's callbacks find it. They get the environment that stride gave to the
/// instance. There are units that pass on a pointer of their own or null instead, call from other
/// threads, or call when their instance is gone; so the pointer is compared, and never followed.
class CallbackReceiver {
 public:
  /// Whether a function has been called that has not returned; on any thread.
  virtual bool is_in_call() const = 0;
  virtual bool is_called_by_this_thread() const = 0;

  /// Calls take(unit) for the one that a callback is for, which does not go meanwhile: the one with
  /// this environment, or else the one of which this thread, or else the only one of which any
  /// thread, is in a call. Nothing, if there is none of this class. Throws what take() throws.
  template <class Unit, class Take>
  static void with_receiver(const void* environment, Take&& take) {
    const std::lock_guard lock(mutex_);
    if (auto* const unit = dynamic_cast<Unit*>(find(environment))) take(*unit);
  }
  /// The same one for a callback that the unit makes within a call of its own thread, which lasts
  /// as long as the callback; null if there is none.
  template <class Unit>
  static Unit* find_caller(const void* environment) {
    const std::lock_guard lock(mutex_);
    return dynamic_cast<Unit*>(find(environment));
  }

 protected:
  CallbackReceiver() = default;
  ~CallbackReceiver() = default;
  CallbackReceiver(const CallbackReceiver&) = delete;
  CallbackReceiver& operator=(const CallbackReceiver&) = delete;

  /// What the unit is given.
  void* environment() { return this; }
  /// To be called at the end of the constructor, and at the beginning of the destructor, where it
  /// waits for callbacks.
  void begin_receiving();
  void end_receiving();

 private:
  static CallbackReceiver* find(const void* environment);

  static inline std::mutex mutex_;
  static inline std::set<CallbackReceiver*> receivers_;  ///< whose order shows nowhere
};

}  // namespace stride::importer

#endif
