#include "master/base/process/process_state.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

using stride::core::ProcessState;

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

std::string number_text() {
  std::ostringstream text;
  text << 1.5;
  return text.str();
}

locale_t other_locale() {
  static const locale_t locale = ::newlocale(LC_ALL_MASK, "C.UTF-8", nullptr);
  return locale;
}

mode_t present_mask() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return mask;
}

rlim_t open_files() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  return limit.rlim_cur;
}

void set_open_files(rlim_t count) {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = count;
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &limit) == 0);
}

void block(int signal) {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, signal);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

void (*handler_of(int signal))(int) {
  struct sigaction action {};
  ::sigaction(signal, nullptr, &action);
  return action.sa_handler;
}

void handle(int) {}

}  // namespace

TEST_CASE("nothing has changed") { CHECK(ProcessState().restore().empty()); }

TEST_CASE("each change is put back once, and named") {
  ::setenv("STRIDE_TEST_KEPT", "a=b", 1);
  ::unsetenv("STRIDE_TEST_NEW");
  const auto [change, name] = GENERATE(table<std::function<void()>, std::string>({
      {[] { fs::current_path("/"); }, "the working folder"},
      {[] { ::umask(0123); }, "the mask of files' modes (umask)"},
      {[] { ::setenv("STRIDE_TEST_KEPT", "c", 1); }, "the environment variable STRIDE_TEST_KEPT"},
      {[] { ::unsetenv("STRIDE_TEST_KEPT"); }, "the environment variable STRIDE_TEST_KEPT"},
      {[] { ::setenv("STRIDE_TEST_NEW", "", 1); }, "the environment variable STRIDE_TEST_NEW"},
      {[] { std::setlocale(LC_ALL, "C.UTF-8"); }, "the locale"},
      {[] { std::locale::global(std::locale(std::locale(), new Comma)); }, "the locale"},
      {[] { ::uselocale(other_locale()); }, "the locale"},
      {[] { std::signal(SIGINT, SIG_IGN); }, "the handler of SIGINT"},
      {[] { std::signal(SIGCHLD, handle); }, "the handler of SIGCHLD"},
      {[] { std::signal(SIGABRT, SIG_IGN); }, "the handler of SIGABRT"},
      {[] { block(SIGTERM); }, "the blocking of SIGTERM"},
      {[] { set_open_files(20); }, "a resource limit"},
      {[] { std::fesetround(FE_TOWARDZERO); }, "the mode of the processor (rounding toward zero)"},
  }));
  const auto folder = fs::current_path();
  const mode_t mask = present_mask();
  const rlim_t files = open_files();
  const auto interrupt = handler_of(SIGINT);  // Catch2 has one
  const ProcessState before;
  change();
  CHECK(before.restore() == Texts{name});
  CHECK(before.restore().empty());
  CHECK(fs::current_path() == folder);
  CHECK(present_mask() == mask);
  CHECK(open_files() == files);
  CHECK(std::string(std::getenv("STRIDE_TEST_KEPT")) == "a=b");
  CHECK(std::getenv("STRIDE_TEST_NEW") == nullptr);
  CHECK(std::string(std::setlocale(LC_ALL, nullptr)) == "C");
  CHECK(number_text() == "1.5");
  CHECK(handler_of(SIGINT) == interrupt);
  CHECK(handler_of(SIGCHLD) == SIG_DFL);
  CHECK(std::fegetround() == FE_TONEAREST);
}

TEST_CASE("files that other threads make meanwhile have the mode that they should have") {
  const mode_t expected = 0666 & ~present_mask();
  const std::string file =
      fs::temp_directory_path() / ("stride-mode-" + std::to_string(::getpid()));
  std::atomic<bool> is_over = false;
  std::atomic<int> others = 0;
  std::thread maker([&] {
    while (!is_over) {
      const int made = ::open(file.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
      struct stat status {};
      if (::fstat(made, &status) != 0 || (status.st_mode & 0777) != expected) ++others;
      ::close(made);
      ::unlink(file.c_str());
    }
  });
  for (int i = 0; i < 300; ++i) ProcessState().restore();
  is_over = true;
  maker.join();
  CHECK(others == 0);
}

TEST_CASE("of many variables that are gone, some are named") {
  for (const char* name : {"STRIDE_TEST_1", "STRIDE_TEST_2", "STRIDE_TEST_3", "STRIDE_TEST_4",
                           "STRIDE_TEST_5", "STRIDE_TEST_6"}) {
    ::setenv(name, "x", 1);
  }
  const ProcessState before;
  ::clearenv();
  const Texts changes = before.restore();
  REQUIRE(changes.size() == 1);
  CHECK(changes[0].starts_with("the environment variables "));
  CHECK(changes[0].ends_with(" more"));
  CHECK(changes[0].size() < 200);
  CHECK(std::string(std::getenv("STRIDE_TEST_5")) == "x");
}

TEST_CASE("a folder is found again where it has another name by now") {
  const fs::path folder =
      fs::temp_directory_path() / ("stride-state-" + std::to_string(::getpid()));
  const fs::path here = fs::current_path();
  fs::create_directory(folder);
  fs::current_path(folder);
  const ProcessState before;
  fs::current_path("/");
  const fs::path moved = folder.string() + "-moved";
  fs::rename(folder, moved);
  CHECK(before.restore() == Texts{"the working folder"});
  CHECK(fs::current_path() == moved);
  fs::current_path(here);
  fs::remove(moved);
}

TEST_CASE("what harms no other code stays") {
  const ProcessState before;
  const rlim_t files = open_files();
  SECTION("a function that handles a crash") {
    const auto crash = handler_of(SIGBUS);
    std::signal(SIGBUS, handle);
    CHECK(before.restore().empty());
    CHECK(handler_of(SIGBUS) == handle);
    std::signal(SIGBUS, crash);
  }
  SECTION("a signal that stride has no use for") {
    std::signal(SIGUSR1, handle);
    block(SIGUSR2);
    CHECK(before.restore().empty());
    CHECK(handler_of(SIGUSR1) == handle);
    std::signal(SIGUSR1, SIG_DFL);
  }
  SECTION("a limit that has become wider") {
    set_open_files(files - 1);
    const ProcessState narrow;
    set_open_files(files);
    CHECK(narrow.restore().empty());
    CHECK(open_files() == files);
  }
  SECTION("the variable that is set for each unit") {
    ::setenv("STRIDE_RESULTS", "/somewhere", 1);
    CHECK(before.restore().empty());
    CHECK(std::string(std::getenv("STRIDE_RESULTS")) == "/somewhere");
  }
}

TEST_CASE("in a process of a unit's own only what numbers depend on is put back") {
  const ProcessState everything;
  const ProcessState numbers(ProcessState::Extent::Numbers);
  std::setlocale(LC_ALL, "C.UTF-8");
  std::fesetround(FE_UPWARD);
  std::signal(SIGINT, SIG_IGN);
  fs::current_path("/");
  CHECK(numbers.restore() == Texts{"the mode of the processor (rounding upward)", "the locale"});
  CHECK(everything.restore() == Texts{"the working folder", "the handler of SIGINT"});
}
