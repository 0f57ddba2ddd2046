#include "master/base/files/untrusted_folder.h"

#include <cerrno>

#include <catch2/catch.hpp>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::tests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMost = 1000;

/// A folder "in" with files, and one outside.
struct Folders {
  TemporaryFolder folder;

  Folders() {
    fs::create_directories(folder / "in/a/b");
    folder.write("in/a/b/file", "content");
    folder.write("secret", "secret");
  }
  UntrustedFolder inside() const { return UntrustedFolder(folder / "in"); }
  void link(const std::string& to, const std::string& from) const {
    fs::create_symlink(folder / to, folder / from);
  }
};

bool is_there(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

}  // namespace

TEST_CASE("a regular file is read") {
  const Folders f;
  CHECK(f.inside().read("a/b/file", kMost) == "content");
  CHECK(f.inside().size("a/b/file") == 7U);
  CHECK(f.inside().open("a/b/file") != nullptr);
  fs::create_directory_symlink(f.folder / "in", f.folder / "link");
  CHECK(UntrustedFolder(f.folder / "link").read("a/b/file", kMost) == "content");
}

TEST_CASE("what is not there is told apart from what is refused") {
  const Folders f;
  CHECK(f.inside().open("a/none") == nullptr);
  CHECK(errno == ENOENT);
  CHECK(f.inside().open("none/file") == nullptr);
  CHECK(errno == ENOENT);
  CHECK(UntrustedFolder(f.folder / "none").open("file") == nullptr);
  CHECK(errno == ENOENT);
}

TEST_CASE("links, FIFOs, folders and paths that lead out are refused") {
  const Folders f;
  f.link("secret", "in/link");
  f.link("in/a", "in/near");
  f.link("", "in/up");
  REQUIRE(::mkfifo((f.folder / "in/fifo").c_str(), 0600) == 0);
  const fs::path path = GENERATE(as<fs::path>{}, "link", "near/b/file", "up/secret", "fifo", "a",
                                 "../secret", "a/../a/b/file", "./a/b/file", "a/b/", "", "/");
  INFO(path);
  CHECK(f.inside().open(path) == nullptr);
  CHECK(errno != ENOENT);
  CHECK_FALSE(f.inside().size(path));
  CHECK_FALSE(f.inside().read(path, kMost));
}

TEST_CASE("a file is not read beyond a limit") {
  const Folders f;
  f.folder.write("in/large", std::string(200'000, 'x'));
  CHECK(f.inside().read("large", 200'000)->size() == 200'000);
  CHECK_FALSE(f.inside().read("large", 199'999));
  CHECK_FALSE(f.inside().read("large", 10));
}

TEST_CASE("links and special files are removed at any depth, and nothing else") {
  const Folders f;
  f.link("secret", "in/link");
  f.link("none", "in/a/dangling");
  f.link("", "in/a/b/up");
  REQUIRE(::mkfifo((f.folder / "in/a/fifo").c_str(), 0600) == 0);
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{AF_UNIX, {}};
  const std::string name = (f.folder / "in/a/socket").string();
  REQUIRE(name.copy(address.sun_path, sizeof address.sun_path - 1) == name.size());
  REQUIRE(::bind(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
  ::close(socket);
  f.inside().remove_special_files();
  for (const char* gone : {"in/link", "in/a/dangling", "in/a/b/up", "in/a/fifo", "in/a/socket"}) {
    INFO(gone);
    CHECK_FALSE(is_there(f.folder / gone));
  }
  CHECK(content(f.folder / "in/a/b/file") == "content");
  CHECK(content(f.folder / "secret") == "secret");
  CHECK_NOTHROW(UntrustedFolder(f.folder / "none").remove_special_files());
}

TEST_CASE("folders that are closed to their owner are searched, too") {
  const Folders f;
  f.link("secret", "in/a/b/link");
  fs::permissions(f.folder / "in/a/b", fs::perms::owner_exec);
  fs::permissions(f.folder / "in/a", fs::perms::none);
  f.inside().remove_special_files();
  CHECK_FALSE(is_there(f.folder / "in/a/b/link"));
}

TEST_CASE("folders that are too deep to be searched are an error") {
  const Folders f;
  const fs::path before = fs::current_path();
  REQUIRE(::chdir((f.folder / "in").c_str()) == 0);
  int depth = 0;
  for (; depth < 300; ++depth) {
    if (::mkdir("d", 0700) != 0 || ::chdir("d") != 0) break;
  }
  REQUIRE(::chdir(before.c_str()) == 0);
  REQUIRE(depth == 300);
  rlimit limit{};
  REQUIRE(::getrlimit(RLIMIT_NOFILE, &limit) == 0);
  const rlimit few{256, limit.rlim_max};
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &few) == 0);
  CHECK_THAT(error_of([&] { f.inside().remove_special_files(); }),
             Contains("cannot search this folder, which an earlier run has left: Too many open "
                      "files"));
  REQUIRE(::setrlimit(RLIMIT_NOFILE, &limit) == 0);
}
