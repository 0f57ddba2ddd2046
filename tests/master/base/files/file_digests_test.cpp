#include "master/base/files/file_digests.h"

#include <filesystem>
#include <fstream>

#include <catch2/catch.hpp>

#include "master/base/error.h"
#include "master/base/files/sha256.h"
#include "tests/scratch_folder.h"

using namespace stride;

TEST_CASE("digests of files and folders are kept") {
  const tests::ScratchFolder folder;
  std::filesystem::create_directories(folder / "a/b");
  std::ofstream(folder / "a/one") << "1";
  core::FileDigests digests;
  CHECK(digests.of(folder / "a/one") == core::sha256("1"));
  const std::string whole = digests.of(folder / "a");
  CHECK(whole == core::sha256_of_folder(folder / "a"));
  std::ofstream(folder / "a/b/two") << "2";
  CHECK(core::sha256_of_folder(folder / "a") != whole);
  CHECK(digests.of(folder / "a") == whole);
  CHECK_THROWS_AS(digests.of(folder / "none"), core::Error);
}
