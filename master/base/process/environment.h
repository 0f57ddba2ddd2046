// The variables that programs and libraries are configured with.
#ifndef STRIDE_MASTER_BASE_PROCESS_ENVIRONMENT_H
#define STRIDE_MASTER_BASE_PROCESS_ENVIRONMENT_H

#include <string>
#include <vector>

namespace stride::core {

/// The environment variables, but for STRIDE_RESULTS, which is set anew for each unit.
class Environment {
 public:
  Environment();

  /// Puts back what differs, and adds it to `changes`, in words.
  void restore(std::vector<std::string>& changes) const;

 private:
  std::vector<std::string> entries_;  ///< "NAME=VALUE"
};

}  // namespace stride::core

#endif
