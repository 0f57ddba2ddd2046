// What a run must not leave behind: processes, and shared memory with a name.
#ifndef STRIDE_TESTS_CLI_LEFTOVERS_H
#define STRIDE_TESTS_CLI_LEFTOVERS_H

#include <set>
#include <string>
#include <vector>

#include <sys/types.h>

namespace stride::tests {

/// Watches over the runs that are started while it exists: an environment variable marks them, and
/// all processes that come from them, however far they have gone from their parents.
class Leftovers {
 public:
  Leftovers();
  ~Leftovers();
  Leftovers(const Leftovers&) = delete;
  Leftovers& operator=(const Leftovers&) = delete;

  /// Those of the living processes that come from such runs and have this name; all, if it is
  /// empty.
  std::vector<pid_t> processes(const std::string& name = "") const;
  /// All that is left now, in words.
  std::vector<std::string> all() const;
  /// What is left when some seconds have been given to go.
  std::vector<std::string> after_a_while() const;

 private:
  std::string mark_;
  std::set<std::string> shared_memory_;  ///< what was there before
};

}  // namespace stride::tests

#endif
