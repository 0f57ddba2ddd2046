#ifndef STRIDE_TESTS_MASTER_BASE_OPEN_FILE_LIMIT_H
#define STRIDE_TESTS_MASTER_BASE_OPEN_FILE_LIMIT_H

#include <sys/resource.h>

namespace stride::tests {

/// This process can open no file beyond the first so many while an object of this class lives.
class OpenFileLimit {
 public:
  explicit OpenFileLimit(rlim_t files) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit limit{files, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &limit);
  }
  ~OpenFileLimit() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  OpenFileLimit(const OpenFileLimit&) = delete;
  OpenFileLimit& operator=(const OpenFileLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace stride::tests

#endif
