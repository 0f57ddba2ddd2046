#include "master/base/child_process/landlock.h"

#include <vector>

#include <sys/stat.h>

#include "tests/master/base/child_process/sandbox_support.h"

using namespace stride::isolation;
using namespace stride::tests;
namespace fs = std::filesystem;

namespace {

Descriptor open_path(const fs::path& path) {
  return Descriptor(::open(path.c_str(), O_PATH | O_CLOEXEC));
}

/// Two folders, each with a file and a folder in it.
struct Folders {
  ScratchFolder scratch;
  fs::path open = scratch / "open";
  fs::path closed = scratch / "closed";

  Folders() {
    for (const fs::path& folder : {open, closed}) {
      fs::create_directories(folder / "inner");
      write_file(folder / "file", "text");
    }
  }

  /// What the work says where `open` may be written to, under a Landlock of this version.
  std::string say(int version, const std::function<std::string()>& work) const {
    return in_child([&] {
      ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
      std::vector<Descriptor> writable;
      writable.push_back(open_path(open));
      restrict_files(writable, version);
      return work();
    });
  }
};

/// All that changes a folder or the files in it, but for renaming to another one.
const std::vector<std::pair<const char*, std::function<long(const fs::path&)>>> kChanges{
    {"write", [](const fs::path& in) { return ::open((in / "file").c_str(), O_WRONLY); }},
    {"append", [](const fs::path& in) { return ::open((in / "file").c_str(), O_RDWR | O_APPEND); }},
    {"create", [](const fs::path& in) { return ::creat((in / "new").c_str(), 0600); }},
    {"rename",
     [](const fs::path& in) { return ::rename((in / "file").c_str(), (in / "other").c_str()); }},
    {"link",
     [](const fs::path& in) { return ::link((in / "file").c_str(), (in / "other").c_str()); }},
    {"unlink", [](const fs::path& in) { return ::unlink((in / "file").c_str()); }},
    {"mkdir", [](const fs::path& in) { return ::mkdir((in / "new").c_str(), 0700); }},
    {"rmdir", [](const fs::path& in) { return ::rmdir((in / "inner").c_str()); }},
    {"symlink", [](const fs::path& in) { return ::symlink("file", (in / "new").c_str()); }},
    {"mkfifo", [](const fs::path& in) { return ::mkfifo((in / "new").c_str(), 0600); }},
};

}  // namespace

TEST_CASE("what a folder holds is changed where that is allowed, and nowhere else") {
  if (lacks_landlock()) return;
  const int version = GENERATE(range(1, landlock_version() + 1));
  for (const auto& [name, change] : kChanges) {
    const Folders folders;
    INFO(name << ", Landlock " << version);
    CHECK(folders.say(version, [&] { return answer(change(folders.closed)); }) == "EACCES");
    CHECK(folders.say(version, [&] { return answer(change(folders.open)); }) == "done");
    CHECK(content(folders.closed / "file") == "text");
  }
}

TEST_CASE("a file is renamed from one folder to another if both may change") {
  if (lacks_landlock()) return;
  const Folders folders;
  const auto move = [&](const fs::path& from, const fs::path& to) {
    return folders.say(landlock_version(),
                       [&] { return answer(::rename(from.c_str(), to.c_str())); });
  };
  CHECK(move(folders.open / "file", folders.closed / "inner/file") == "EACCES");
  CHECK(move(folders.closed / "file", folders.open / "inner/file") == "EACCES");
  CHECK(move(folders.open / "file", folders.open / "inner/file") == "done");
  CHECK(content(folders.open / "inner/file") == "text");
}

TEST_CASE("a file cannot be cut off") {
  if (lacks_landlock() || landlock_version() < kLandlockTruncates) return;
  const Folders folders;
  const fs::path file = folders.closed / "file";
  const auto say = [&](const auto& work) { return folders.say(landlock_version(), work); };
  CHECK(say([&] { return answer(::truncate(file.c_str(), 0)); }) == "EACCES");
  CHECK(say([&] { return open_file(file, O_RDONLY | O_TRUNC); }) == "EACCES");
  CHECK(say([&] { return answer(::truncate((folders.open / "file").c_str(), 1)); }) == "done");
  CHECK(content(file) == "text");
  CHECK(content(folders.open / "file") == "t");
}

TEST_CASE("what is open already can be written") {
  if (lacks_landlock()) return;
  const Folders folders;
  const Descriptor file(::open((folders.closed / "file").c_str(), O_WRONLY | O_CLOEXEC));
  CHECK(folders.say(landlock_version(), [&] {
    const std::string cut = answer(::ftruncate(file.number(), 0));
    return cut + answer(::write(file.number(), "more", 4));
  }) == "donedone");
  CHECK(content(folders.closed / "file") == "more");
}

TEST_CASE("reading, running and the null device stay as they are") {
  if (lacks_landlock()) return;
  const Folders folders;
  const int version = GENERATE(range(1, landlock_version() + 1));
  CHECK(folders.say(version, [&] { return content(folders.closed / "file"); }) == "text");
  CHECK(folders.say(version, [] {
    return std::to_string(std::system("/bin/cat /proc/self/status >/dev/null"));
  }) == "0");
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/full", "/dev/urandom"}) {
    INFO(device);
    CHECK(folders.say(version, [&] { return open_file(device, O_RDWR); }) == "done");
    CHECK(folders.say(version, [&] { return open_file(device, O_WRONLY | O_TRUNC); }) == "done");
  }
}

TEST_CASE("no terminal or other device is opened, also not for reading") {
  if (lacks_landlock()) return;
  const Folders folders;
  const Terminal terminal;
  const int version = GENERATE(range(1, landlock_version() + 1));
  for (const std::string& device : {terminal.name, std::string("/dev/ptmx")}) {
    INFO(device << ", Landlock " << version);
    for (const int flags : {O_RDONLY, O_RDWR}) {
      const auto work = [&] { return open_file(device, flags | O_NOCTTY | O_NONBLOCK); };
      CHECK(in_child(work) == "done");
      CHECK(folders.say(version, work) == "EACCES");
    }
  }
  CHECK(folders.say(version, [] { return open_file("/dev/stdin", O_RDONLY); }) == "done");
  CHECK(folders.say(version, [] { return open_file("/proc/self/status", O_RDONLY); }) == "done");
}

TEST_CASE("memory shared by its name can be read") {
  if (lacks_landlock() || !fs::exists("/dev/shm")) return;
  const Folders folders;
  const ScratchFolder shared("/dev/shm");
  const fs::path file = write_file(shared / "file", "text");
  CHECK(folders.say(landlock_version(), [&] { return content(file); }) == "text");
  CHECK(folders.say(landlock_version(), [&] { return open_file(file, O_RDWR); }) == "EACCES");
}

TEST_CASE("a single file may be what can be written") {
  if (lacks_landlock()) return;
  const Folders folders;
  CHECK(in_child([&] {
          ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
          std::vector<Descriptor> writable;
          writable.push_back(open_path(folders.closed / "file"));
          restrict_files(writable, landlock_version());
          return open_file(folders.closed / "file", O_WRONLY) +
                 open_file(folders.closed / "new", O_WRONLY | O_CREAT);
        }) == "doneEACCES");
}
