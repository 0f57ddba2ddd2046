#include "master/base/child_process/sandbox.h"

#include <csignal>
#include <thread>

#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "master/base/child_process/system_calls.h"
#include "tests/master/base/child_process/sandbox_support.h"

using namespace stride::isolation;
using namespace stride::tests;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

/// What the work says in a sandbox.
std::string say(const std::vector<WritableFolder>& writable,
                const std::function<std::string()>& work) {
  return in_child([&] {
    enter_sandbox(writable);
    return work();
  });
}

std::string say(const std::function<std::string()>& work) { return say({}, work); }

/// What a program prints.
std::string output_of(const std::string& command) {
  std::string text;
  std::FILE* const pipe = ::popen(command.c_str(), "r");
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  ::pclose(pipe);
  return text;
}

std::string status_line(const std::string& name) {
  return output_of("grep ^" + name + ": /proc/self/status");
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

bool is_root() { return ::geteuid() == 0; }

}  // namespace

TEST_CASE("no files are sent through sockets where memory is limited") {
  const auto say_with = [](bool has_memory_limit) {
    return in_child([&] {
      const Protections protections = enter_sandbox({}, has_memory_limit);
      const msghdr message{};
      return joined(protections.in_force) + answer(::sendmsg(-1, &message, 0));
    });
  };
  CHECK_THAT(say_with(false), !Contains("files sent through sockets") && Contains("EBADF"));
  const std::string said = say_with(true);
  if (said.find("seccomp") == said.npos) return;  // the kernel has no filters
  CHECK_THAT(said, Contains("no files sent through sockets") && Contains("EACCES"));
}

TEST_CASE("the protections in force and the missing ones are listed") {
  const ScratchFolder scratch;
  const std::string said = in_child([&] {
    const Protections protections =
        enter_sandbox(std::vector{WritableFolder{scratch / ".", "its notes"}});
    return joined(protections.in_force) + "missing:\n" + joined(protections.missing);
  });
  INFO(said);
  CHECK_THAT(said, Contains("no new privileges\n"));
  CHECK_THAT(said, Contains("no core dump, at most 4096 open files\n"));
  if (lacks_landlock()) return;
  const int version = landlock_version();
  CHECK_THAT(said, Contains("read-only files, but for its notes: Landlock " +
                            std::to_string(version) + "\n"));
  CHECK_THAT(said, Contains("no network: seccomp\n"));
  CHECK((said.find("missing:\n") + 9 == said.size()) == (version >= kLandlockSignals));
}

TEST_CASE("protections that the kernel lacks are listed, and the others are in force") {
  const std::string said = in_child([] {
    for (int i = 0; i < 16; ++i) enter_sandbox({});  // as deep as Landlock can be nested
    const Protections protections = enter_sandbox({});
    return joined(protections.in_force) + "missing:\n" + joined(protections.missing);
  });
  const std::size_t missing = said.find("missing:\n");
  if (lacks_landlock()) return;
  CHECK_THAT(said.substr(missing),
             Contains("read-only files (") && Contains("Argument list too long"));
  CHECK_THAT(said.substr(0, missing), Contains("no network: seccomp\n"));
}

TEST_CASE("a folder that is not there is an error") {
  const ChildOutcome outcome = run_in_child([] {
    enter_sandbox(std::vector<WritableFolder>{{"/nowhere/at/all", "nowhere"}});
    return std::string();
  });
  CHECK(outcome.end == ChildOutcome::End::Threw);
  CHECK_THAT(outcome.text, Contains("cannot open '/nowhere/at/all': No such file or directory"));
}

TEST_CASE("files are written in the folders that are named, also by the programs it starts") {
  if (lacks_landlock()) return;
  const ScratchFolder open;
  const ScratchFolder closed;
  const auto write_in = [&](const ScratchFolder& folder) {
    const std::string file = (folder / "file").string();
    return say({{open / ".", "open"}}, [&] { return output_of("echo text 2>&1 >" + file); });
  };
  CHECK(write_in(open).empty());
  CHECK(content(open / "file") == "text\n");
  CHECK_THAT(write_in(closed), Contains("Permission denied"));
  CHECK_FALSE(fs::exists(closed / "file"));
}

TEST_CASE("there is no way round by /dev/shm or a mount") {
  if (lacks_landlock()) return;
  CHECK(say([] { return open_file("/dev/shm/stride-test", O_RDWR | O_CREAT); }) == "EACCES");
  CHECK(say([] { return answer(::mount("none", "/mnt", "tmpfs", 0, nullptr)); }) == "EACCES");
}

TEST_CASE("signals and debuggers do not leave it") {
  if (lacks_landlock()) return;
  const pid_t other = ::getpid();
  CHECK(say([&] { return answer(::ptrace(PTRACE_ATTACH, other, nullptr, nullptr)); }) == "EPERM");
  if (landlock_version() < kLandlockSignals) return;
  CHECK(say([&] { return answer(::kill(other, SIGCONT)); }) == "EPERM");
  CHECK(say([] {
          const pid_t child = ::fork();
          if (child == 0) ::pause();
          const std::string sent = answer(::kill(child, SIGKILL));
          ::waitpid(child, nullptr, 0);
          return sent + answer(::kill(::getpid(), SIGCONT));
        }) == "donedone");
}

TEST_CASE("the network is away, also for the programs it starts") {
  CHECK(say([] {
          return answer(::socket(AF_INET, SOCK_STREAM, 0)) + " " +
                 answer(::socket(AF_UNIX, SOCK_STREAM, 0));
        }) == "EACCES done");
  CHECK_THAT(say([] { return output_of("bash -c 'echo >/dev/tcp/127.0.0.1/1' 2>&1"); }),
             Contains("Permission denied"));
}

TEST_CASE("limits cannot be raised again") {
  CHECK(say([] {
          rlimit limit{};
          ::getrlimit(RLIMIT_CORE, &limit);
          const bool no_core = limit.rlim_max == 0;
          ::getrlimit(RLIMIT_NOFILE, &limit);
          const bool few_files = limit.rlim_cur <= 4096 && limit.rlim_max <= 4096;
          limit.rlim_max += 1;
          return std::to_string(no_core) + std::to_string(few_files) +
                 answer(::setrlimit(RLIMIT_NOFILE, &limit));
        }) == "11EPERM");
}

TEST_CASE("a set-user-ID program gains nothing") {
  CHECK_THAT(say([] { return status_line("NoNewPrivs"); }), Contains("1"));
  if (!is_root()) return;  // who else could make one?
  const ScratchFolder scratch;
  fs::permissions(scratch / ".", fs::perms::all);
  const fs::path program = scratch / "id";
  fs::copy_file("/usr/bin/id", program);
  ::chmod(program.c_str(), 04755);
  const auto effective_user = [&](bool is_sandboxed) {
    return in_child([&] {
      constexpr uid_t kNobody = 65534;
      if (::setuid(kNobody) != 0) return std::string("no setuid()");
      if (is_sandboxed) enter_sandbox({});
      return output_of(program.string() + " -u");
    });
  };
  if (effective_user(false) != "0\n") return;  // no such programs in this file system
  CHECK(effective_user(true) == "65534\n");
}

TEST_CASE("of root's privileges those for files are left") {
  if (!is_root()) return;
  const ScratchFolder scratch;
  const auto privileges = [](const std::string& text) {
    return std::stoull(text.substr(text.find(':') + 1), nullptr, 16);
  };
  for (const char* set : {"CapEff", "CapPrm", "CapInh"}) {
    INFO(set);
    CHECK((privileges(say([&] { return status_line(set); })) & ~0x1fULL) == 0);
  }
  const fs::path foreign = write_file(scratch / "file", "text");
  ::chown(foreign.c_str(), 65534, 65534);
  ::chmod(foreign.c_str(), 0600);
  CHECK(say({{scratch / ".", "scratch"}}, [&] { return open_file(foreign, O_RDWR); }) ==
        in_child([&] { return open_file(foreign, O_RDWR); }));
}

TEST_CASE("what a unit needs is left") {
  CHECK(say([] { return content("/proc/self/status").empty() ? "empty" : "read"; }) == "read");
  CHECK(say([] {
          int ends[2];
          const std::string made = answer(::pipe(ends));
          return made + answer(::write(ends[1], "x", 1));
        }) == "donedone");
  CHECK(say([] {
          int number = 0;
          std::thread([&] { number = 42; }).join();
          return std::to_string(number);
        }) == "42");
  CHECK(say([] {
          const int memory = ::memfd_create("memory", MFD_CLOEXEC);
          return answer(::ftruncate(memory, 4096));
        }) == "done");
  CHECK(say([] { return open_file("/dev/null", O_RDWR); }) == "done");
  CHECK(say([] { return output_of("echo to the pipe >/dev/stdout"); }) == "to the pipe\n");
}
