#include "master/base/archive/zip.h"

#include <sys/stat.h>

#include "master/base/archive/unpacked_archive.h"
#include "tests/master/base/archive/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

TEST_CASE("what was written is what is unpacked") {
  const Scratch scratch;
  scratch.write("folder/a.txt", "a");
  scratch.write("folder/deep/run.sh", "b");
  fs::permissions(scratch / "folder/deep/run.sh", fs::perms::owner_all);
  archive::Contents contents;
  contents["top.xml"].text = "<x/>";
  archive::add_folder(contents, "resources/", scratch / "folder");
  archive::write_zip(scratch / "x.zip", contents);
  const archive::UnpackedArchive unpacked(scratch / "x.zip", "an archive");
  CHECK(read(unpacked.folder() / "top.xml") == "<x/>");
  CHECK(read(unpacked.folder() / "resources/a.txt") == "a");
  const fs::path script = unpacked.folder() / "resources/deep/run.sh";
  CHECK(read(script) == "b");
  CHECK((fs::status(script).permissions() & fs::perms::owner_exec) != fs::perms::none);
}

TEST_CASE("an archive depends on its contents alone, and replaces another when it is complete") {
  const Scratch scratch;
  archive::Contents contents;
  archive::add_file(contents, "a", scratch.write("a", "text"), false);
  archive::write_zip(scratch / "one.zip", contents);
  fs::last_write_time(scratch / "a", fs::file_time_type::clock::now() - std::chrono::hours(1));
  archive::write_zip(scratch / "two.zip", contents);
  CHECK(read(scratch / "one.zip") == read(scratch / "two.zip"));
  const std::string before = read(scratch / "one.zip");
  fs::remove(scratch / "a");
  CHECK_THROWS(archive::write_zip(scratch / "one.zip", contents));
  CHECK(read(scratch / "one.zip") == before);
}

TEST_CASE("what cannot be packed is an error") {
  const Scratch scratch;
  archive::Contents contents;
  CHECK_THAT(input_error([&] { archive::add_file(contents, "a", scratch / "absent", false); }),
             Contains("absent' is not a file"));
  CHECK_THAT(input_error([&] { archive::add_folder(contents, "", scratch / "absent"); }),
             Contains("absent' is not a folder"));
  archive::add_file(contents, "a", scratch.write("a", "text"), false);
  CHECK_THAT(input_error([&] { archive::add_file(contents, "a", scratch / "a", false); }),
             Contains("two files would be 'a'"));
}

TEST_CASE("a folder that a link in it leads back to is refused, one that is there twice is not") {
  const Scratch scratch;
  scratch.write("folder/a/x.txt", "x");
  fs::create_symlink("a", scratch / "folder/b");
  archive::Contents contents;
  archive::add_folder(contents, "", scratch / "folder");
  CHECK(contents.size() == 2);
  fs::create_symlink("..", scratch / "folder/a/up");
  CHECK_THAT(input_error([&] { archive::add_folder(contents, "", scratch / "folder"); }),
             Contains("/up: this link leads to a folder that it is in itself"));
}

TEST_CASE("a FIFO or a loop of links is not packed") {
  const Scratch scratch;
  fs::create_directory(scratch / "folder");
  const bool is_fifo = GENERATE(true, false);
  if (is_fifo) {
    REQUIRE(::mkfifo((scratch / "folder/x").c_str(), 0600) == 0);
  } else {
    fs::create_symlink("x", scratch / "folder/x");
  }
  archive::Contents contents;
  CHECK_THAT(input_error([&] { archive::add_folder(contents, "", scratch / "folder"); }),
             Contains("folder/x' is not a file that can be packed"));
}

TEST_CASE("an archive that cannot be written is named as the user knows it") {
  const Scratch scratch;
  archive::Contents contents;
  contents["x"].text = "x";
  CHECK_THAT(run_error([&] { archive::write_zip(scratch / "none/x.zip", contents); }),
             Contains("cannot write '" + (scratch / "none/x.zip").string() + "': "));
}
