#include "master/base/files/input_file.h"

#include <fstream>
#include <string>

#include <catch2/catch.hpp>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "master/base/error.h"
#include "tests/error_of.h"
#include "tests/master/base/open_file_limit.h"
#include "tests/scratch_folder.h"

using namespace stride::core;
using namespace stride::tests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

fs::path write(const ScratchFolder& folder, const std::string& name, const std::string& text) {
  std::ofstream(folder / name, std::ios::binary) << text;
  return folder / name;
}

void make_socket(const fs::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.string().copy(address.sun_path, sizeof address.sun_path - 1);
  const Descriptor socket(::socket(AF_UNIX, SOCK_STREAM, 0));
  REQUIRE(::bind(socket.number(), reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
}

}  // namespace

TEST_CASE("a regular file is read whole, also through a link") {
  const ScratchFolder folder;
  const std::string text(200'000, 'x');
  write(folder, "large", text);
  fs::create_symlink("large", folder / "link");
  CHECK(read_input(folder / "large") == text);
  CHECK(read_input(folder / "link") == text);
  CHECK(read_input(write(folder, "empty", "")).empty());
  CHECK_THAT(read_input("/proc/self/status"), Contains("Name:"));  // whose size is 0 before
}

TEST_CASE("what is no regular file is refused by name and kind, and not waited for") {
  const ScratchFolder folder;
  REQUIRE(::mkfifo((folder / "fifo").c_str(), 0600) == 0);
  make_socket(folder / "socket");
  fs::create_symlink("fifo", folder / "link");
  const auto [file, kind] = GENERATE(table<std::string, std::string>({{"fifo", "a FIFO"},
                                                                      {"link", "a FIFO"},
                                                                      {"socket", "a socket"},
                                                                      {"/dev/zero", "a device"},
                                                                      {".", "a folder"}}));
  const fs::path path = fs::path(file).is_absolute() ? fs::path(file) : folder / file;
  CHECK_THAT(error_of([&] { read_input(path); }),
             Contains(path.string() + ": this is " + kind + ", not a regular file"));
  CHECK_THAT(error_of([&] { read_input(path, "shown"); }), Contains("shown: this is " + kind));
  CHECK_THAT(error_of([&] {
               open_input(path, Location{"x.ssd", 7});
             }),
             Contains("x.ssd:7: '" + path.string() + "': this is " + kind));
  CHECK(head_of(path, 4).empty());
}

TEST_CASE("what cannot be reached is named with the reason") {
  const ScratchFolder folder;
  fs::create_symlink("loop", folder / "loop");
  CHECK_THAT(error_of([&] { read_input(folder / "none"); }), Contains("none: the file does not"));
  CHECK_THAT(error_of([&] { read_input(folder / "loop"); }),
             Contains("loop: cannot read the file"));
  CHECK_THAT(error_of([&] { read_input(folder / std::string(300, 'n')); }),
             Contains("File name too long"));
  CHECK_THAT(error_of([&] { read_input("/proc/self/mem"); }),
             Contains("/proc/self/mem: cannot read the file"));
  CHECK(why_unreachable(folder / "none").empty());
  CHECK(why_unreachable(folder / "").empty());
  CHECK_FALSE(why_unreachable(folder / "loop").empty());
  CHECK_FALSE(path_exists(folder / "loop"));
  CHECK_FALSE(is_file(folder / std::string(300, 'n')));
}

TEST_CASE("a file of more bytes than are read is refused") {
  const ScratchFolder folder;
  const fs::path file = write(folder, "x", "12345");
  CHECK(read_input(file, "", 5) == "12345");
  CHECK_THAT(error_of([&] { read_input(file, "", 4); }), Contains("x: the file has more than 4"));
  fs::resize_file(file, std::uintmax_t{1} << 40);  // takes no room on the disk
  CHECK_THAT(error_of([&] { read_input(file, "", 1 << 20); }), Contains("more than 1048576 bytes"));
}

TEST_CASE("a process that has too many open files is no mistake of the user") {
  const ScratchFolder folder;
  const fs::path file = write(folder, "x", "text");
  const OpenFileLimit limit(0);
  try {
    open_input(file);
    FAIL("it was opened");
  } catch (const Error& error) {
    CHECK(error.kind() == Error::Kind::Run);
    CHECK_THAT(error.what(), Contains("x: cannot read the file: Too many open files"));
  }
}

TEST_CASE("the head of a file may be shorter than wanted") {
  const ScratchFolder folder;
  const fs::path file = write(folder, "x", "12345");
  CHECK(head_of(file, 2) == "12");
  CHECK(head_of(file, 9) == "12345");
  CHECK(head_of(folder / "none", 9).empty());
}

TEST_CASE("a copy is the same, or fails with the file's name") {
  const ScratchFolder folder;
  const std::string text(200'000, 'x');
  copy_input(write(folder, "x", text), folder / "copy");
  CHECK(read_input(folder / "copy") == text);
  CHECK_THAT(error_of([&] { copy_input(folder / "x", "/dev/full"); }),
             Contains("/dev/full: cannot write the file"));
  CHECK_THAT(error_of([&] { copy_input("/dev/zero", folder / "y"); }), Contains("a device"));
}

TEST_CASE("what is in a folder comes sorted, and a folder that is none has nothing") {
  const ScratchFolder folder;
  write(folder, "b", "");
  write(folder, "a", "");
  CHECK(folder_entries(folder / "") == std::vector{folder / "a", folder / "b"});
  CHECK(folder_entries(folder / "none").empty());
}
