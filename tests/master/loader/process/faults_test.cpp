// Every way in which a unit may end its process is an error that names it, and nothing is left.
#include <array>
#include <chrono>
#include <csignal>
#include <thread>

#include <sys/ptrace.h>

#include "master/base/child_process/child.h"
#include "master/base/child_process/children.h"
#include "master/base/child_process/shared_memory.h"
#include "tests/build.h"
#include "tests/master/loader/process/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

/// The error of the step to 2 s, in which the unit does it.
std::string error_of_fault(Fixture& unit, const std::string& fault) {
  unit.start({{"fault", fault}, {"at", "1.5"}});
  unit.step(0, 1);
  return run_error([&] { unit.step(1, 2); });
}

constexpr const char* kHead = "system.ssd:7: unit 'u', at 1 s: ";

}  // namespace

TEST_CASE("every kind of end of a unit's process is an error with its cause") {
  const auto [fault, says] = GENERATE(table<std::string, std::string>({
      {"segfault", "its process was ended by signal 11 (SIGSEGV) in fmi3DoStep"},
      {"abort", "its process was ended by signal 6 (SIGABRT) in fmi3DoStep"},
      {"kill", "its process was ended by signal 9 (SIGKILL) in fmi3DoStep"},
      {"exit", "it ended its process with exit code 3 in fmi3DoStep"},
      {"_exit", "it ended its process with exit code 4 in fmi3DoStep"},
      {"exit in a thread", "it ended its process with exit code 5 in fmi3DoStep"},
      {"throw in a thread", "its process was ended by signal 6 (SIGABRT) in fmi3DoStep"},
  }));
  CAPTURE(fault);
  const Belongings before;
  {
    Fixture unit("faulty");
    CHECK_THAT(error_of_fault(unit, fault),
               Catch::StartsWith(kHead + says) && Contains("\n  it printed: now comes: " + fault));
    CHECK_THAT(run_error([&] { unit.step(1, 2); }),
               Contains("it cannot be called, because " + says));
    CHECK_THROWS_AS(state(*unit).save_state(), core::Error);
    CHECK_NOTHROW(unit->terminate());
  }
  CHECK(Belongings() == before);
}

TEST_CASE("the error has the last output of the unit") {
  Fixture unit("faulty");
  const std::string error = error_of_fault(unit, "abort");
  CHECK_THAT(error, Contains("\n  it printed: now comes: abort\n"
                             "  it printed: the model is inconsistent"));
}

TEST_CASE("the end of the process during the instantiation is an error") {
  const Belongings before;
  CHECK_THAT(run_error([] { Fixture("faulty", true, {}, {}, "dies_at_birth"); }),
             Contains("unit 'dies_at_birth': its process was ended by signal 6 (SIGABRT) in "
                      "fmi3InstantiateCoSimulation"));
  CHECK(Belongings() == before);
}

TEST_CASE("an instantiation that takes longer than the limit ends, before there is a time") {
  const Belongings before;
  CHECK_THAT(
      run_error([] { Fixture("faulty", true, {.call_limit = 300ms}, {}, "dozes_at_birth"); }),
      Contains("unit 'dozes_at_birth': it took longer than 0.3 s in "
               "fmi3InstantiateCoSimulation, so its process was ended"));
  CHECK(Belongings() == before);
}

TEST_CASE("a call that takes longer than its limit ends") {
  const std::string fault = GENERATE("loop", "stop");
  CAPTURE(fault);
  const Belongings before;
  {
    Fixture unit("faulty", true, {.call_limit = 300ms});
    CHECK_THAT(error_of_fault(unit, fault),
               Catch::StartsWith(kHead + std::string("it took longer than 0.3 s in fmi3DoStep, so "
                                                     "its process was ended")) &&
                   Contains("it printed: now comes: " + fault));
    CHECK_THROWS_AS(unit.number("y"), core::Error);
  }
  CHECK(Belongings() == before);
}

TEST_CASE("without a limit a long call is logged") {
  Fixture unit("faulty", true, {}, {.warn_after = 20ms});
  unit.start({{"fault", GENERATE(as<std::string>(), "loop", "stop")}});
  const pid_t server = Fixture::server();
  std::thread user([&] {  // who ends the process
    std::this_thread::sleep_for(2s);
    ::kill(server, SIGKILL);
  });
  CHECK_THROWS_AS(unit.step(0, 1), core::Error);
  user.join();
  std::size_t told = 0;
  for (const Fixture::Line& line : unit.log) {
    told += line.text.find("it has taken more than 0.02 s in fmi3DoStep") == 0;
  }
  CHECK(told == 1);
}

TEST_CASE("a killed process is noticed at the next call, and between calls") {
  Fixture unit("faulty");
  unit.start();
  unit.step(0, 1);
  ::kill(Fixture::server(), SIGKILL);
  CHECK_THAT(run_error([&] { unit.step(1, 2); }), Contains("signal 9 (SIGKILL)"));
}

TEST_CASE("without its supervisor a unit's process ends, and the master notices") {
  const bool ignores_children = GENERATE(false, true);  // as a unit in this process may
  CAPTURE(ignores_children);
  const Belongings before;
  {
    Fixture unit("faulty", true, {.call_limit = 5s});
    unit.start();
    const pid_t server = Fixture::server(), supervisor = Fixture::supervisor();
    if (ignores_children) std::signal(SIGCHLD, SIG_IGN);
    ::kill(supervisor, SIGKILL);
    CHECK_THAT(run_error([&] {
                 for (int i = 0; i < 100'000; ++i) unit.number("y");
               }),
               Contains("something has ended its supervisor"));
    CHECK(has_ended(server));
  }
  std::signal(SIGCHLD, SIG_DFL);
  CHECK(Belongings() == before);
}

TEST_CASE("a supervisor that was stopped goes on when it is needed") {
  const Belongings before;
  {
    Fixture unit("faulty");
    unit.start({{"fault", "abort"}});
    ::kill(Fixture::supervisor(), SIGSTOP);
    CHECK_THAT(run_error([&] { unit.step(0, 1); }), Contains("signal 6 (SIGABRT)"));
    ::kill(Fixture::supervisor(), SIGSTOP);
  }
  CHECK(Belongings() == before);
}

TEST_CASE("a supervisor that cannot be continued does not hold the end up") {
  const Belongings before;
  {
    Fixture unit("faulty");
    unit.start({{"fault", "daemon"}});
    unit.step(0, 1);
    const pid_t supervisor = Fixture::supervisor();
    std::vector<pid_t> supervised;
    while (supervised.size() < 2) supervised = isolation::descendants_of(supervisor);
    // stopped by a debugger it does not obey SIGCONT
    if (::ptrace(PTRACE_SEIZE, supervisor, nullptr, nullptr) != 0) return;
    ::ptrace(PTRACE_INTERRUPT, supervisor, nullptr, nullptr);
    ::waitpid(supervisor, nullptr, __WALL);
    unit.destroy();
    for (const pid_t process : supervised) CHECK(has_ended(process));
  }
  CHECK(Belongings() == before);
}

TEST_CASE("when the master is killed nothing of it is left") {
  const Scratch scratch;
  const isolation::Shared<std::array<pid_t, 2>> processes;
  isolation::run_in_child([&] {
    Fixture unit("faulty");
    const Fixture other("faulty");  // whose processes do not keep those of the first
    unit.start({{"fault", "daemon"}});
    unit.step(0, 1);
    *processes = {Fixture::supervisor(), Fixture::server()};
    std::raise(SIGKILL);
    return std::string();
  });
  for (const pid_t process : *processes) {
    REQUIRE(process != 0);
    CHECK(has_ended(process));
  }
  // by the last supervisor, which removes them when it has seen that the master is gone
  for (int i = 0; i < 1000 && !left_folders(scratch).empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(left_folders(scratch).empty());
}

TEST_CASE("what a unit prints reaches the log, line by line") {
  Fixture unit("faulty");
  unit.start({{"fault", "print"}, {"at", "0.5"}});
  unit.step(0, 1);
  unit->terminate();
  unit.destroy();
  std::size_t lines = 0;
  for (const Fixture::Line& line : unit.log) {
    lines += line.category == isolation::kPrinted && line.text.find("line ") == 0 &&
             line.text.size() == 62;
  }
  CHECK(lines == 16384);
}

TEST_CASE("a unit that overwrites what it shares with others harms itself only") {
  const Belongings before;
  {
    Fixture other("faulty");
    Fixture unit("faulty", true, {.call_limit = 20s});
    other.start();
    unit.start({{"fault", "overwrite"}});
    try {
      unit.step(0, 1);
    } catch (const core::Error&) {
    }
    other.step(0, 1);
    CHECK(other.number("y") == 1);
  }
  CHECK(Belongings() == before);
}

TEST_CASE("a unit that prints without end is ended as any other that does not come to an end") {
  Fixture unit("faulty", true, {.call_limit = 300ms});
  CHECK_THAT(error_of_fault(unit, "print for ever"), Contains("it took longer than 0.3 s"));
}

TEST_CASE("a unit that takes more memory than it may have is an error") {
  if (kSanitized) return;  // AddressSanitizer needs memory of its own without end
  Fixture unit("faulty", true, {.memory_limit = std::uint64_t{64} << 20});
  CHECK_THAT(error_of_fault(unit, "allocate"), Contains(kHead) && Contains("bad_alloc"));
}
