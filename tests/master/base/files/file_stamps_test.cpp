#include "master/base/files/file_stamps.h"

#include <chrono>

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using stride::core::FileStamps;
using stride::tests::TemporaryFolder;

TEST_CASE("a file has changed when it is gone, replaced or written to") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "file";
  folder.write("file", "one");
  folder.write("other", "one");
  FileStamps stamps;
  stamps.add(file);
  stamps.add(folder / "none");
  CHECK_FALSE(stamps.changed());
  last_write_time(file, last_write_time(file) - std::chrono::seconds(1));
  CHECK(stamps.changed() == file);
  stamps.add(file);
  CHECK_FALSE(stamps.changed());
  rename(folder / "other", file);
  CHECK(stamps.changed() == file);
  stamps.add(file);
  remove(file);
  CHECK(stamps.changed() == file);
}

TEST_CASE("of what is in a folder it counts that it is there") {
  const TemporaryFolder folder;
  create_directories(folder / "a/b");
  folder.write("a/b/file", "one");
  FileStamps stamps;
  stamps.add(folder / "a");
  folder.write("a/b/file", "another");
  folder.write("a/further", "");
  CHECK_FALSE(stamps.changed());
  remove(folder / "a/b/file");
  CHECK(stamps.changed() == folder / "a/b/file");
  remove_all(folder / "a");
  CHECK(stamps.changed() == folder / "a");
}
