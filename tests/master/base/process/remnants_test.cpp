#include "master/base/process/remnants.h"

#include <atomic>
#include <csignal>
#include <optional>
#include <thread>

#include <catch2/catch.hpp>
#include <dlfcn.h>
#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

using Catch::Matchers::Contains;
using stride::core::Remnants;

namespace {

/// A thread that waits until the object goes.
class Waiting {
 public:
  explicit Waiting(const char* name) { ::pthread_setname_np(thread_.native_handle(), name); }
  ~Waiting() {
    is_over_ = true;
    is_over_.notify_all();
    thread_.join();
  }

 private:
  std::atomic<bool> is_over_ = false;
  std::thread thread_{[this] { is_over_.wait(false); }};
};

/// That the function of this name in the library is said to handle a signal; it is never sent.
class Handler {
 public:
  Handler(void* library, const char* function) {
    void* const address = ::dlsym(library, function);
    REQUIRE(address != nullptr);
    std::signal(SIGUSR2, reinterpret_cast<void (*)(int)>(address));
  }
  ~Handler() { std::signal(SIGUSR2, SIG_DFL); }
};

}  // namespace

TEST_CASE("threads that there are beside those of before are found, until they end") {
  const Waiting earlier("earlier");
  const Remnants remnants;
  CHECK(remnants.find() == "");
  {
    const Waiting pump("pump");
    CHECK(remnants.find() == "1 thread ('pump')");
    const Waiting timer("timer");
    CHECK(remnants.find() == "2 threads ('pump', 'timer')");
  }
  CHECK(remnants.find() == "");
}

TEST_CASE("of many threads some are named") {
  const Remnants remnants;
  std::optional<Waiting> threads[6];
  for (std::size_t i = 0; i < std::size(threads); ++i) {
    threads[i].emplace(("worker-" + std::to_string(i)).c_str());
  }
  CHECK(remnants.find() == "6 threads ('worker-0', 'worker-1', 'worker-2', 'worker-3', …)");
}

TEST_CASE("a thread that is about to end has some time for it") {
  const Remnants remnants;
  std::thread([] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }).detach();
  CHECK(remnants.find() == "");
}

TEST_CASE("a fork of the process has no more threads than it") {
  const Remnants remnants;
  const pid_t fork = ::fork();
  if (fork == 0) ::_exit(remnants.find().empty() ? 0 : 1);
  int status = -1;
  ::waitpid(fork, &status, 0);
  CHECK(status == 0);
}

TEST_CASE("functions of the program itself may handle signals") {
  const Remnants remnants;
  std::signal(SIGUSR2, [](int) {});
  CHECK(remnants.find() == "");
  std::signal(SIGUSR2, SIG_DFL);
}

TEST_CASE("functions of libraries that were there before may handle signals, others are found") {
  std::optional<Remnants> remnants(std::in_place);
  {
    const Handler of_before(RTLD_DEFAULT, "gnu_get_libc_version");
    CHECK(remnants->find() == "");
  }
  void* const library = ::dlopen("libresolv.so.2", RTLD_NOW | RTLD_LOCAL);
  REQUIRE(library != nullptr);
  {
    const Handler of_later(library, "ns_sprintrr");
    CHECK(remnants->find() == "a handler of SIGUSR2");
  }
  remnants.emplace();
  {
    const Handler of_before(library, "ns_sprintrr");
    CHECK(remnants->find() == "");
  }
  ::dlclose(library);
}
