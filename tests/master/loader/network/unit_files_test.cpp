#include "master/loader/network/unit_files.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/scratch_folder.h"

using namespace stride::remote;
using namespace stride::tests;

namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

std::string read_text(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("files come back, in folders, empty and of several pieces, and links do not") {
  const ScratchFolder from, to;
  const std::string large(3'000'000, 'l');
  write_text(from / "a.txt", "a");
  write_text(from / "traces/deep/b.vcd", large);
  write_text(from / "empty", "");
  fs::create_symlink("/etc/passwd", from / "link");
  UnitFileWriter writer(to / "");
  std::size_t pieces = 0;
  const std::string left_out = read_unit_files(
      from / "", [&](const std::string& name, std::string_view bytes, bool is_first) {
        ++pieces;
        writer.take(name, bytes, is_first);
      });
  CHECK(read_text(to / "a.txt") == "a");
  CHECK((read_text(to / "traces/deep/b.vcd") == large));
  CHECK(fs::is_regular_file(to / "empty"));
  CHECK_FALSE(fs::exists(to / "link"));
  CHECK(pieces == 5);
  CHECK(left_out == "1 of its files are links or the like, or cannot be read, and stay there");
}

TEST_CASE("a peer cannot write elsewhere") {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "inside");
  fs::create_directory_symlink("..", scratch / "inside/up");
  fs::create_symlink("../victim", scratch / "inside/file");
  UnitFileWriter writer(scratch / "inside");
  for (const char* name :
       {"../x", "/tmp/stride-x", "a/../../x", "", ".", "..", "a/", "up/x", "file"}) {
    INFO(name);
    CHECK_FALSE(error_of([&] { writer.take(name, "x", true); }) == "(no error)");
  }
  CHECK_FALSE(fs::exists(scratch / "x"));
  CHECK_FALSE(fs::exists(scratch / "victim"));
  writer.take("a/b", "1", true);
  writer.take("a/b", "2", false);
  CHECK(read_text(scratch / "inside/a/b") == "12");
}
