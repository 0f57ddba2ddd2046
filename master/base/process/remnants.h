// What code leaves in its process that would go on where the code is no longer.
#ifndef STRIDE_MASTER_BASE_PROCESS_REMNANTS_H
#define STRIDE_MASTER_BASE_PROCESS_REMNANTS_H

#include <array>
#include <csignal>
#include <set>
#include <string>

#include <sys/types.h>

struct link_map;

namespace stride::core {

/// Notes which threads, libraries and functions that handle signals there are, before a library is
/// loaded. Threads and handlers that there are beside them later may be of the library, or of
/// another one that it has loaded: as long as they exist, it cannot be unloaded. A handler that is
/// in the program, or in a library that was there before, does not count. A thread that the program
/// has started meanwhile does: nothing tells whose code it runs.
class Remnants {
 public:
  Remnants();

  /// What there is beside them, in words: "2 threads ('pump', 'timer')"; empty if there is nothing.
  /// Threads that are about to end have a tenth of a second for it.
  std::string find() const;

 private:
  std::set<pid_t> new_threads() const;
  std::set<pid_t> threads_that_stay() const;

  std::set<pid_t> threads_;
  std::set<const link_map*> objects_;
  std::array<struct sigaction, NSIG> actions_{};
};

}  // namespace stride::core

#endif
