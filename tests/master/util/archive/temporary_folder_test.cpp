#include "master/util/archive/temporary_folder.h"

#include <sys/wait.h>
#include <unistd.h>

#include "tests/master/util/archive/support.h"

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

TEST_CASE("a parent folder that others can write to is refused") {
  const Scratch scratch;
  fs::create_directory(TemporaryFolder::parent());
  fs::permissions(TemporaryFolder::parent(), fs::perms::all);
  CHECK_THAT(run_error([] { TemporaryFolder(); }), Contains("belongs to you alone"));
}

TEST_CASE("a parent folder that is a link is refused") {
  const Scratch scratch;
  fs::create_directory(scratch / "elsewhere");
  fs::create_directory_symlink(scratch / "elsewhere", TemporaryFolder::parent());
  CHECK_THAT(run_error([] { TemporaryFolder(); }), Contains("belongs to you alone"));
}

TEST_CASE("a TMPDIR that does not exist is an error with a hint") {
  const Scratch scratch;
  setenv("TMPDIR", (scratch / "absent").c_str(), 1);
  CHECK_THAT(run_error([] { TemporaryFolder(); }),
             Contains("absent") && Contains("No such file") && Contains("set TMPDIR"));
}
