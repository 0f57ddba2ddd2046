// How FmuInstance calls the functions of a unit: its templates, for the classes that derive from
// it. Their contracts are in fmu_instance.h.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_FMU_INSTANCE_CALLS_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_FMU_INSTANCE_CALLS_H

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "master/loader/fmu/instance/fmu_instance.h"

namespace stride::importer {

template <class Call>
[[gnu::always_inline]] inline auto FmuInstance::guarded(const char* name, Call&& call) {
  note_call(name);
  try {
    const auto result = call();
    end_call();
    return result;
  } catch (...) {
    fail_thrown(name);
  }
}

template <class Function, class... Arguments>
[[gnu::always_inline]] inline Status FmuInstance::call_discardable(const char* name,
                                                                   Function* function,
                                                                   Arguments... arguments) {
  check_callable(name);
  require(name, function, "values of this type");
  const auto status =
      static_cast<Status>(guarded(name, [&] { return function(instance_, arguments...); }));
  if (status == Status::Ok && !has_messages()) [[likely]]
    return status;
  return check_status(name, status);
}

template <class Function, class... Arguments>
[[gnu::always_inline]] inline void FmuInstance::call(const char* name, Function* function,
                                                     Arguments... arguments) {
  const Status status = call_discardable(name, function, arguments...);
  if (status == Status::Discard || status == Status::Pending) [[unlikely]]
    fail_call(name, status);
  if (watched_calls_ > 0) [[unlikely]]
    restore_process(name);
}

// Forced inline: the hot loop is made of these.

[[gnu::always_inline]] inline FmuInstance::CallSequence::CallSequence(FmuInstance& unit,
                                                                      const char* function,
                                                                      Time time)
    : unit_(unit), function_(function) {
  unit.check_callable(function);
  unit.settle_row();
  unit.time_ = time;
  unit.present_.begin_sequence(time);
  core::ForkMark::set();
}

[[gnu::always_inline]] inline FmuInstance::CallSequence::~CallSequence() {
  unit_.check_mode(function_);
  unit_.present_.end_sequence();
}

template <class Function, class... Arguments>
[[gnu::always_inline]] inline Status FmuInstance::CallSequence::make_call(const char* name,
                                                                          Function* function,
                                                                          Arguments... arguments) {
  unit_.require(name, function, "values of this type");
  ++unit_.calls_;
  unit_.present_.begin_next(name);
  try {
    return static_cast<Status>(function(unit_.instance_, arguments...));
  } catch (...) {
    unit_.fail_thrown(name);
  }
}

template <class Function, class... Arguments>
[[gnu::always_inline]] inline Status FmuInstance::CallSequence::call_discardable(
    const char* name, Function* function, Arguments... arguments) {
  const Status status = make_call(name, function, arguments...);
  if (status == Status::Ok && unit_.is_quiet()) [[likely]]
    return status;
  return unit_.check_left(name, status);
}

template <class Function, class... Arguments>
[[gnu::always_inline]] inline void FmuInstance::CallSequence::call(const char* name,
                                                                   Function* function,
                                                                   Arguments... arguments) {
  const Status status = make_call(name, function, arguments...);
  if (status == Status::Ok && unit_.is_quiet()) [[likely]]
    return;
  unit_.check_left_by_whole_call(name, status);
}

template <class Function, class... Arguments>
void FmuInstance::call_and_watch(const char* name, Function* function, Arguments... arguments) {
  watched_calls_ = kMostWatched;
  call(name, function, arguments...);
}

template <class Function, class... Arguments>
void FmuInstance::call_and_end_watch(const char* name, Function* function, Arguments... arguments) {
  call_and_watch(name, function, arguments...);
  watched_calls_ = 0;
}

template <class Make>
void FmuInstance::instantiate_by(const char* name, Make&& make) {
  check_callable(name);
  instance_ = guarded(name, make);
  restore_process(name);
  watched_calls_ = kMostWatched;
  if (instance_ == nullptr) fail(std::string(name) + " failed: " + take_messages(name));
}

template <class Function>
void FmuInstance::reset_by(const char* name, Function* function) {
  if (function == nullptr) fail(std::string("its library does not export ") + name);
  failed_in_ = nullptr;
  call(name, function);
  time_.reset();
  rejection_reason_.clear();
  save_failure_.clear();
}

template <class Function>
bool FmuInstance::save_by(const char* name, Function* function, void*& state) {
  if (!save_failure_.empty()) [[unlikely]]
    return false;
  if (function == nullptr) {
    give_up_saving(std::string("its library does not export ") + name);
    return false;
  }
  check_callable(name);
  const auto status =
      static_cast<Status>(guarded(name, [&] { return function(instance_, &state); }));
  if (status == Status::Ok && !has_messages()) [[likely]]
    return true;
  if (status == Status::Error || status == Status::Discard) {
    state = nullptr;  // what a failed call leaves there is undefined
    give_up_saving(failure_of(name, status));
    return false;
  }
  if (check_status(name, status) == Status::Pending) fail_call(name, status);
  return true;
}

template <class Function, class... Arguments>
void FmuInstance::call_for_state(const char* name, Function* function, Arguments... arguments) {
  check_callable(name);
  const auto status =
      static_cast<Status>(guarded(name, [&] { return function(instance_, arguments...); }));
  if (status == Status::Ok && !has_messages()) [[likely]]
    return;
  if (status == Status::Error || status == Status::Discard) fail_for_state(name, status);
  if (check_status(name, status) == Status::Pending) fail_call(name, status);
}

template <class Function>
bool FmuInstance::free_by(const char* name, Function* function, void*& state) {
  if (state == nullptr || is_unusable_ || function == nullptr) return false;
  write_note(name);
  if (static_cast<Status>(function(instance_, &state)) == Status::Fatal) mark_unusable();
  end_call();
  return true;
}

template <class Function>
void FmuInstance::free_instance_by(const char* name, Function* function) {
  void* const instance = std::exchange(instance_, nullptr);
  if (is_unusable_) return;
  guarded(name, [&] {
    function(instance);
    return true;
  });
}

template <class Free>
void FmuInstance::free_or_warn(Free&& free) noexcept {
  try {
    free();
  } catch (const std::exception& failure) {
    warn(failure.what());
  }
}

template <class Answer, class Byte>
std::vector<std::uint8_t> FmuInstance::serialized(void* state,
                                                  const Serialization<Answer, Byte>& functions) {
  require(functions.size_name, functions.size_of, functions.capability);
  require(functions.write_name, functions.write, functions.capability);
  if (state == nullptr) fail_null_state(functions.write_name);
  std::size_t size = 0;
  call_for_state(functions.size_name, functions.size_of, state, &size);
  std::vector<std::uint8_t> bytes = bytes_for_state(functions.size_name, size);
  call_for_state(functions.write_name, functions.write, state,
                 reinterpret_cast<Byte*>(bytes.data()), size);
  return bytes;
}

}  // namespace stride::importer

#endif
