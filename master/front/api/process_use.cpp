#include "master/front/api/process_use.h"

#include <shared_mutex>
#include <stdexcept>

namespace stride::api {
namespace {

std::shared_mutex use;
thread_local int calls = 0;  ///< of this thread

}  // namespace

SharedUse::SharedUse() {
  if (calls++ == 0) use.lock_shared();
}

SharedUse::~SharedUse() {
  if (--calls == 0) use.unlock_shared();
}

ExclusiveUse::ExclusiveUse() {
  if (calls > 0) {
    throw std::logic_error(
        "a simulation with units in processes of their own cannot be opened by a function that the "
        "library has called");
  }
  use.lock();
}

ExclusiveUse::~ExclusiveUse() { use.unlock(); }

}  // namespace stride::api
