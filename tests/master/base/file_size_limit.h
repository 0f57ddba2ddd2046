#ifndef STRIDE_TESTS_MASTER_BASE_FILE_SIZE_LIMIT_H
#define STRIDE_TESTS_MASTER_BASE_FILE_SIZE_LIMIT_H

#include <csignal>

#include <sys/resource.h>

namespace stride::tests {

/// Files of this process may not grow beyond a size while an object of this class lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace stride::tests

#endif
