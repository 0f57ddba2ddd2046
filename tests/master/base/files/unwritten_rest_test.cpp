#include "master/base/files/unwritten_rest.h"

#include <memory>

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using stride::core::FileIdentity;
using stride::core::UnwrittenRest;
using stride::tests::content;
using stride::tests::TemporaryFolder;

namespace {

/// Of a file with "one\nhalf", whose first line is whole, and whose next bytes would be these.
std::unique_ptr<UnwrittenRest> rest_of(const std::filesystem::path& file, std::string_view bytes) {
  auto rest = std::make_unique<UnwrittenRest>();
  rest->path.set(file.native());
  rest->identity = *FileIdentity::of(file.c_str());
  rest->place = 8;
  rest->line_end = 4;
  rest->size = bytes.copy(rest->bytes, bytes.size());
  return rest;
}

}  // namespace

TEST_CASE("the whole lines that a file still held are written, once") {
  const TemporaryFolder folder;
  folder.write("x", "one\nhalf");
  const auto rest = rest_of(folder / "x", " a line\nthree\nfo");
  rest->write();
  rest->write();
  CHECK(content(folder / "x") == "one\nhalf a line\nthree\n");
}

TEST_CASE("a line that was begun and not ended is cut off") {
  const TemporaryFolder folder;
  folder.write("x", "one\nhalf");
  rest_of(folder / "x", " a line")->write();
  CHECK(content(folder / "x") == "one\n");
}

TEST_CASE("another file in the place of the first one is left alone") {
  const TemporaryFolder folder;
  folder.write("x", "one\nhalf");
  const auto rest = rest_of(folder / "x", " a line\n");
  folder.write("y", "other");
  std::filesystem::rename(folder / "y", folder / "x");
  rest->write();
  CHECK(content(folder / "x") == "other");
}

TEST_CASE("a rest whose size is damaged is not read beyond its end") {
  const TemporaryFolder folder;
  folder.write("x", "one\nhalf");
  const auto rest = rest_of(folder / "x", "\n");
  rest->size = ~std::size_t{0};
  rest->write();
  CHECK(content(folder / "x") == "one\nhalf\n");
}
