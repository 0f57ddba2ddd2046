#include "master/base/archive/temporary_folder.h"

#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/master/base/archive/support.h"
#include "tests/master/base/open_file_limit.h"

using namespace stride;
using namespace stride::tests;
using archive::TemporaryFolder;
using Catch::Matchers::Contains;

TEST_CASE("it is empty, private, below TMPDIR, and goes with the object") {
  const Scratch scratch;
  fs::path path;
  {
    const TemporaryFolder folder;
    path = folder.path();
    CHECK(fs::is_empty(path));
    CHECK(path.string().starts_with((scratch / "tmp").string()));
    CHECK((fs::status(path).permissions() & fs::perms::others_all) == fs::perms::none);
    std::ofstream(path / "file") << "text";
  }
  CHECK_FALSE(fs::exists(path));
  CHECK_FALSE(fs::exists(path.string() + ".lock"));
}

TEST_CASE("what a crashed process left is swept by the next one; what is in use is not") {
  const Scratch scratch;
  const TemporaryFolder in_use;
  int channel[2];
  REQUIRE(pipe(channel) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const auto* folder = new TemporaryFolder;  // the process ends without its destructor
    std::ofstream(folder->path() / "file") << "text";
    const std::string name = folder->path().string();
    const bool written = write(channel[1], name.data(), name.size()) > 0;
    _exit(written ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  char name[512] = {};
  REQUIRE(read(channel[0], name, sizeof name - 1) > 0);
  REQUIRE(fs::exists(fs::path(name) / "file"));
  const TemporaryFolder next;
  CHECK_FALSE(fs::exists(name));
  CHECK(fs::exists(in_use.path()));
  CHECK(fs::exists(next.path()));
  close(channel[0]);
  close(channel[1]);
}

TEST_CASE("a forked child does not remove its parent's folder") {
  const Scratch scratch;
  auto folder = std::make_unique<TemporaryFolder>();
  const pid_t child = fork();
  if (child == 0) {
    folder.reset();
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(fs::exists(folder->path()));
}

TEST_CASE("a folder that cannot be removed keeps its lock's file, and is swept later") {
  const Scratch scratch;
  const pid_t child = ::fork();
  if (child == 0) {
    auto folder = std::make_unique<TemporaryFolder>();
    const fs::path path = folder->path();
    std::ofstream(path / "file") << "text";
    const OpenFileLimit limit(0);
    folder.reset();
    ::_exit(fs::exists(path) && fs::exists(path.string() + ".lock") ? 0 : 1);
  }
  int status = -1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(status == 0);
  TemporaryFolder::sweep_abandoned();
  CHECK(fs::is_empty(TemporaryFolder::parent()));
}

TEST_CASE("a folder without a lock is swept, what is no such folder is not") {
  const Scratch scratch;
  const TemporaryFolder in_use;
  const fs::path parent = TemporaryFolder::parent();
  fs::create_directories(parent / "unpacked-123456" / "resources");
  fs::create_directory(parent / "other");
  TemporaryFolder::sweep_abandoned();
  CHECK_FALSE(fs::exists(parent / "unpacked-123456"));
  CHECK(fs::exists(parent / "other"));
  CHECK(fs::exists(in_use.path()));
}

TEST_CASE("locks that another process holds stop nobody") {
  const Scratch scratch;
  const fs::path parent = TemporaryFolder().path().parent_path();
  std::vector<int> held;
  for (const char* name : {".lock", "unpacked-of-it.lock"}) {
    std::ofstream(parent / name) << "";
    held.push_back(::open((parent / name).c_str(), O_RDONLY | O_CLOEXEC));
    REQUIRE(::flock(held.back(), LOCK_EX | LOCK_NB) == 0);
  }
  const TemporaryFolder folder;
  CHECK(fs::is_directory(folder.path()));
  CHECK(fs::exists(parent / "unpacked-of-it.lock"));
  for (const int file : held) ::close(file);
  TemporaryFolder::sweep_abandoned();
  CHECK_FALSE(fs::exists(parent / "unpacked-of-it.lock"));
}

TEST_CASE("many processes make folders and remove abandoned ones at a time") {
  const Scratch scratch;
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i) {
    children.push_back(::fork());
    if (children.back() != 0) continue;
    bool is_good = true;
    for (int k = 0; k < 200; ++k) {
      const TemporaryFolder folder;
      std::ofstream(folder.path() / "file") << "text";
      is_good = is_good && fs::exists(folder.path() / "file");
    }
    ::_exit(is_good ? 0 : 1);
  }
  for (const pid_t child : children) {
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
  }
  CHECK(fs::is_empty(TemporaryFolder::parent()));
}

TEST_CASE("folders that were closed to their owner are removed") {
  const Scratch scratch;
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t kOther = 65534;  // root may enter any folder
    if (::geteuid() == 0) {
      for (const fs::path& path : {scratch / ".", scratch / "tmp"}) {
        if (::chown(path.c_str(), kOther, kOther) != 0) ::_exit(2);
      }
      if (::setuid(kOther) != 0) ::_exit(3);
    }
    const auto* folder = new TemporaryFolder;
    fs::create_directories(folder->path() / "a" / "b" / "c");
    fs::create_directory_symlink(scratch / ".", folder->path() / "a" / "link");
    fs::permissions(folder->path() / "a" / "b", fs::perms::none);
    fs::permissions(folder->path() / "a", fs::perms::none);
    delete folder;
    ::_exit(0);
  }
  int status = -1;
  REQUIRE(::waitpid(child, &status, 0) == child);
  CHECK(status == 0);
  REQUIRE(std::distance(fs::directory_iterator(scratch / "tmp"), {}) == 1);
  CHECK(fs::is_empty(fs::directory_iterator(scratch / "tmp")->path()));
}

TEST_CASE("a parent folder that others can write to is refused") {
  const Scratch scratch;
  fs::create_directory(TemporaryFolder::parent());
  fs::permissions(TemporaryFolder::parent(), fs::perms::all);
  CHECK_THAT(input_error([] { TemporaryFolder(); }), Contains("belongs to you alone"));
}

TEST_CASE("a parent folder that is a link is refused") {
  const Scratch scratch;
  fs::create_directory(scratch / "elsewhere");
  fs::create_directory_symlink(scratch / "elsewhere", TemporaryFolder::parent());
  CHECK_THAT(input_error([] { TemporaryFolder(); }), Contains("belongs to you alone"));
}

TEST_CASE("a TMPDIR that does not exist is an error with a hint") {
  const Scratch scratch;
  setenv("TMPDIR", (scratch / "absent").c_str(), 1);
  CHECK_THAT(input_error([] { TemporaryFolder(); }),
             Contains("TMPDIR: cannot make") && Contains("absent") && Contains("No such file") &&
                 Contains("set TMPDIR"));
}
