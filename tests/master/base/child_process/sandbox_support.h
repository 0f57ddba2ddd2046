// Attempts at what a sandbox may forbid, in a process of their own.
#ifndef STRIDE_TESTS_MASTER_BASE_CHILD_PROCESS_SANDBOX_SUPPORT_H
#define STRIDE_TESTS_MASTER_BASE_CHILD_PROCESS_SANDBOX_SUPPORT_H

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <system_error>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/descriptor.h"
#include "master/base/child_process/landlock.h"
#include "tests/scratch_folder.h"

namespace stride::tests {

/// The name of what a system call that returned this has answered: "done", "EACCES".
inline std::string answer(long result) { return result >= 0 ? "done" : ::strerrorname_np(errno); }

/// Opens, and closes again.
inline std::string open_file(const std::filesystem::path& path, int flags) {
  const int file = ::open(path.c_str(), flags | O_CLOEXEC, 0600);
  const std::string result = answer(file);
  if (file >= 0) ::close(file);
  return result;
}

inline std::string content(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline std::filesystem::path write_file(const std::filesystem::path& path,
                                        const std::string& text) {
  std::ofstream(path) << text;
  return path;
}

/// What the work says in a fork of this process; throws what it throws.
inline std::string in_child(const std::function<std::string()>& work) {
  const isolation::ChildOutcome outcome = isolation::run_in_child(work);
  INFO(outcome.text << outcome.printed);
  REQUIRE(outcome.end == isolation::ChildOutcome::End::Answered);
  return outcome.text;
}

/// One of its own; nobody types there.
struct Terminal {
  isolation::Descriptor machine{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)};
  std::string name = opened_name();
  isolation::Descriptor user{::open(name.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)};

 private:
  std::string opened_name() const {
    REQUIRE(::grantpt(machine.number()) == 0);
    REQUIRE(::unlockpt(machine.number()) == 0);
    return ::ptsname(machine.number());
  }
};

/// Says aloud that a test is left out, which must not happen where CI=true.
inline bool is_missing(const char* what, const std::function<void()>& use) {
  try {
    use();
    return false;
  } catch (const std::system_error& error) {
    WARN("skipped: no " << what << " here: " << error.what());
    REQUIRE(std::getenv("CI") == nullptr);
    return true;
  }
}

inline bool lacks_landlock() {
  return is_missing("Landlock", [] { isolation::landlock_version(); });
}

}  // namespace stride::tests

#endif
