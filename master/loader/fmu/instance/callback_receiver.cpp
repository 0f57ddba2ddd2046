#include "master/loader/fmu/instance/callback_receiver.h"

namespace stride::importer {

void CallbackReceiver::begin_receiving() {
  const std::lock_guard lock(mutex_);
  receivers_.insert(this);
}

void CallbackReceiver::end_receiving() {
  const std::lock_guard lock(mutex_);
  receivers_.erase(this);
}

CallbackReceiver* CallbackReceiver::find(const void* environment) {
  auto* const named = const_cast<CallbackReceiver*>(
      static_cast<const CallbackReceiver*>(environment));  // if it is one
  if (receivers_.contains(named)) return named;
  CallbackReceiver* in_call = nullptr;
  bool is_only = true;
  for (CallbackReceiver* const candidate : receivers_) {
    if (!candidate->is_in_call()) continue;
    if (candidate->is_called_by_this_thread()) return candidate;
    is_only = in_call == nullptr;
    in_call = candidate;
  }
  return is_only ? in_call : nullptr;
}

}  // namespace stride::importer
