#ifndef STRIDE_TESTS_MASTER_UTIL_NO_OPEN_FILES_H
#define STRIDE_TESTS_MASTER_UTIL_NO_OPEN_FILES_H

#include <sys/resource.h>

namespace stride::tests {

/// This process can open no file while an object of this class lives.
class NoOpenFiles {
 public:
  NoOpenFiles() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const rlimit none{0, before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoOpenFiles() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoOpenFiles(const NoOpenFiles&) = delete;
  NoOpenFiles& operator=(const NoOpenFiles&) = delete;

 private:
  rlimit before_{};
};

}  // namespace stride::tests

#endif
