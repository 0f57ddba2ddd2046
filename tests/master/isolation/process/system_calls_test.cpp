#include "master/isolation/process/system_calls.h"

#include <initializer_list>

#include <linux/io_uring.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include "tests/master/isolation/process/sandbox_support.h"

using namespace stride::isolation;
using namespace stride::tests;

namespace {

void filtered(void (*forbid)()) {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  forbid();
}

std::string say_filtered(void (*forbid)(), const std::function<std::string()>& work) {
  return in_child([&] {
    filtered(forbid);
    return work();
  });
}

bool lacks_seccomp() {
  return is_missing("seccomp", [] {
    const ChildOutcome outcome = run_in_child([] {
      filtered(forbid_network);
      return std::string("fine");
    });
    if (outcome.text != "fine")
      throw std::system_error(ENOSYS, std::generic_category(), outcome.text);
  });
}

}  // namespace

TEST_CASE("of the sockets only those within the machine are left") {
  if (lacks_seccomp()) return;
  for (const int domain : {AF_INET, AF_INET6, AF_PACKET, AF_NETLINK, AF_VSOCK, AF_ALG}) {
    for (const int type : {SOCK_STREAM, SOCK_DGRAM, SOCK_RAW}) {
      INFO("domain " << domain << ", type " << type);
      CHECK(say_filtered(forbid_network, [&] { return answer(::socket(domain, type, 0)); }) ==
            "EACCES");
    }
  }
  CHECK(say_filtered(forbid_network, [] { return answer(::socket(AF_UNIX, SOCK_STREAM, 0)); }) ==
        "done");
  CHECK(say_filtered(forbid_network, [] {
          int ends[2];
          const std::string made = answer(::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends));
          return made + answer(::send(ends[0], "x", 1, 0));
        }) == "donedone");
}

TEST_CASE("no socket comes by way of io_uring, and nothing is typed into a terminal") {
  if (lacks_seccomp()) return;
  CHECK(say_filtered(forbid_network, [] {
          io_uring_params parameters{};
          return answer(::syscall(SYS_io_uring_setup, 1, &parameters));
        }) == "EACCES");
  const char key = '\n';
  CHECK(say_filtered(forbid_network,
                     [&] { return answer(::ioctl(STDIN_FILENO, TIOCSTI, &key)); }) == "EACCES");
  CHECK(in_child([&] { return answer(::ioctl(STDIN_FILENO, TIOCSTI, &key)); }) == "ENOTTY");
  CHECK(say_filtered(forbid_network, [] {
          return answer(::ioctl(STDIN_FILENO, TIOCGWINSZ, nullptr));
        }) == "ENOTTY");
}

#ifdef __x86_64__
TEST_CASE("a 32-bit call gets nothing that others do not") {
  if (lacks_seccomp()) return;
  const auto socket32 = [](long domain) {  // as a 32-bit program makes it
    long result = 359;
    asm volatile("int $0x80"
                 : "+a"(result)
                 : "b"(domain), "c"(static_cast<long>(SOCK_STREAM)), "d"(0L)
                 : "memory", "r8", "r9", "r10", "r11");
    return result;
  };
  const auto say32 = [&](long domain, auto before) {
    return in_child([&] {
      before();
      return std::to_string(socket32(domain));
    });
  };
  if (std::stol(say32(AF_INET, [] {})) == -ENOSYS) return;  // the kernel has no 32-bit programs
  CHECK(std::stol(say32(AF_INET, [] {})) >= 0);
  CHECK(say32(AF_INET, [] { filtered(forbid_network); }) == std::to_string(-EACCES));
  CHECK(std::stol(say32(AF_UNIX, [] { filtered(forbid_network); })) >= 0);
}
#endif

TEST_CASE("files are not cut off by name") {
  if (lacks_seccomp()) return;
  const ScratchFolder scratch;
  const auto file = write_file(scratch / "file", "text");
  const auto say_of = [&](const auto& work) { return say_filtered(forbid_truncation, work); };
  CHECK(say_of([&] { return answer(::truncate(file.c_str(), 0)); }) == "EACCES");
  CHECK(say_of([&] { return open_file(file, O_RDONLY | O_TRUNC); }) == "EACCES");
  CHECK(say_of([&] { return answer(::syscall(SYS_open, file.c_str(), O_RDONLY | O_TRUNC)); }) ==
        "EACCES");
  CHECK(content(file) == "text");
  // who may write it may do that, too: Landlock sees to it
  CHECK(say_of([&] { return open_file(file, O_RDONLY); }) == "done");
  CHECK(say_of([&] { return open_file(file, O_WRONLY | O_TRUNC); }) == "done");
  CHECK(content(file).empty());
}
