// Who is inside of the library, in a process with several threads.
#ifndef STRIDE_MASTER_FRONT_API_PROCESS_USE_H
#define STRIDE_MASTER_FRONT_API_PROCESS_USE_H

namespace stride::api {

/// During a call. Calls in a call count once.
class SharedUse {
 public:
  SharedUse();
  ~SharedUse();
  SharedUse(const SharedUse&) = delete;
  SharedUse& operator=(const SharedUse&) = delete;
};

/// While the process is forked for units of their own: waits for the calls of other threads, since
/// what they hold, such as the loader's lock, would be held in the fork for ever. Throws
/// std::logic_error inside of a call.
class ExclusiveUse {
 public:
  ExclusiveUse();
  ~ExclusiveUse();
  ExclusiveUse(const ExclusiveUse&) = delete;
  ExclusiveUse& operator=(const ExclusiveUse&) = delete;
};

}  // namespace stride::api

#endif
