#include "master/base/child_process/memory_use.h"

#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/child.h"
#include "tests/build.h"
#include "tests/scratch_folder.h"

using namespace stride::isolation;

namespace {

constexpr std::size_t kSize = std::size_t{32} << 20;

void* fill(void* block) {
  if (block == MAP_FAILED) std::abort();
  return std::memset(block, 'x', kSize);
}

void* map(int flags, int file = -1) {
  return ::mmap(nullptr, kSize, PROT_READ | PROT_WRITE, flags, file, 0);
}

/// A file with kSize bytes.
int nameless_file() {
  const int file = ::memfd_create("test", 0);
  const std::string bytes(kSize, 'x');
  if (::write(file, bytes.data(), kSize) != static_cast<ssize_t>(kSize)) std::abort();
  return file;
}

/// In a process of its own: by how many times kSize the memory of that process and of its children
/// is more when the work is done.
double growth(const std::function<std::vector<pid_t>()>& work) {
  const ChildOutcome outcome = run_in_child([&] {
    const MemoryUse use({});
    std::vector<pid_t> processes{::getpid()};
    const std::uint64_t before = use.of(processes);
    const std::vector<pid_t> further = work();
    processes.insert(processes.end(), further.begin(), further.end());
    const std::uint64_t after = use.of(processes);
    const bool is_bounded = use.bound(processes) >= after;
    return is_bounded ? std::to_string(static_cast<double>(after - before) / kSize) : "above";
  });
  INFO(outcome.text << outcome.printed);
  REQUIRE(outcome.end == ChildOutcome::End::Answered);
  return std::stod(outcome.text);
}

/// Runs the work in another child, which then sleeps, and waits until it is done.
std::vector<pid_t> beside(const std::function<void()>& work) {
  int ends[2];
  if (::pipe(ends) != 0) std::abort();
  const pid_t child = ::fork();
  if (child == 0) {
    work();
    if (::write(ends[1], "x", 1) != 1) std::abort();
    for (;;) ::pause();
  }
  char done = 0;
  if (::read(ends[0], &done, 1) != 1) std::abort();
  return {child};
}

/// AddressSanitizer keeps what was freed for a while [MiB].
const double kSlack = stride::tests::kSanitized ? 1.5 : 0.2;

}  // namespace

TEST_CASE("each kind of memory counts once") {
  const auto alone = [](const std::function<void()>& work) {
    return growth([&] {
      work();
      return std::vector<pid_t>{};
    });
  };
  constexpr int kOwn = MAP_PRIVATE | MAP_ANONYMOUS;
  constexpr int kCommon = MAP_SHARED | MAP_ANONYMOUS;
  CHECK(alone([] { fill(map(kOwn)); }) == Approx(1).margin(kSlack));
  CHECK(alone([] { fill(map(kCommon)); }) == Approx(1).margin(kSlack));
  CHECK(alone([] { nameless_file(); }) == Approx(1).margin(kSlack));
  CHECK(alone([] { fill(map(MAP_SHARED, nameless_file())); }) == Approx(1).margin(kSlack));
  CHECK(alone([] { map(kOwn); }) == Approx(0).margin(0.2));
  CHECK(alone([] { ::munmap(fill(map(kCommon)), kSize); }) == Approx(0).margin(0.2));
}

TEST_CASE("a file that is mapped and closed counts") {
  CHECK(growth([] {
          const int file = nameless_file();
          fill(map(MAP_SHARED, file));
          ::close(file);
          return std::vector<pid_t>{};
        }) == Approx(1).margin(kSlack));
}

TEST_CASE("what processes share counts once, and what each has counts for each") {
  CHECK(growth([] {
          fill(map(MAP_PRIVATE | MAP_ANONYMOUS));
          return beside([] {});
        }) == Approx(1).margin(kSlack));
  CHECK(growth([] {
          void* const block = fill(map(MAP_SHARED | MAP_ANONYMOUS));
          return beside([&] { fill(block); });
        }) == Approx(1).margin(kSlack));
  CHECK(growth([] {
          void* const block = fill(map(MAP_PRIVATE | MAP_ANONYMOUS));
          return beside([&] { fill(block); });
        }) == Approx(2).margin(0.2));
}

TEST_CASE("pages of a file on a disk do not count, and files of folders in memory do") {
  const stride::tests::ScratchFolder scratch;
  const std::filesystem::path disk = scratch / "disk";
  std::filesystem::create_directory(disk);
  std::string memory = "/dev/shm/stride-test-XXXXXX";
  if (::mkdtemp(memory.data()) == nullptr) return;  // there is no such folder
  const MemoryUse use({disk, memory});
  const std::uint64_t before = use.of({});
  for (const std::filesystem::path& folder : {disk, std::filesystem::path(memory)}) {
    const int file = ::open((folder / "file").c_str(), O_RDWR | O_CREAT, 0600);
    const std::string bytes(kSize, 'x');
    CHECK(::write(file, bytes.data(), kSize) == static_cast<ssize_t>(kSize));
    ::close(file);
  }
  CHECK(use.of({}) == before + kSize);
  CHECK(use.bound({}) == before + kSize);
  std::filesystem::remove_all(memory);
}

TEST_CASE("a process that does not exist takes no memory") {
  const pid_t none = -1;
  CHECK(MemoryUse({}).of(std::span(&none, 1)) == 0);
  CHECK(MemoryUse({}).bound(std::span(&none, 1)) == 0);
}
