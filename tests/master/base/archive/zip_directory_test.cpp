#include "master/base/archive/zip_directory.h"

#include "master/base/files/input_file.h"
#include "tests/master/base/archive/support.h"

using namespace stride;
using namespace stride::tests;
using archive::announced_entries;

namespace {

std::optional<std::uint64_t> announced(const Scratch& scratch, const std::string& bytes) {
  return announced_entries(core::open_input(scratch.write("x.zip", bytes)));
}

std::string little_endian(std::uint64_t number, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(number >> 8 * i & 0xFF);
  return bytes;
}

/// The end of an archive whose directory has so many entries, with a comment.
std::string end_record(std::uint64_t entries) {
  return "PK\x05\x06" + std::string(6, '\0') + little_endian(entries, 2) + std::string(8, '\0') +
         little_endian(3, 2) + "abc";
}

/// The same of zip64, whose record is at the begin of the file.
std::string end_record64(std::uint64_t entries) {
  const std::string record =
      "PK\x06\x06" + std::string(28, '\0') + little_endian(entries, 8) + std::string(16, '\0');
  const std::string locator = "PK\x06\x07" + std::string(16, '\0');
  return record + locator + end_record(0xFFFF);
}

}  // namespace

TEST_CASE("the end of an archive announces its entries") {
  const Scratch scratch;
  const fs::path zip = make_zip(scratch / "three.zip", {{"a"}, {"b"}, {"c"}});
  CHECK(announced_entries(core::open_input(zip)) == 3);
  CHECK(announced(scratch, end_record(1000)) == 1000);
  CHECK(announced(scratch, end_record(0xFFFF)) == 0xFFFF);
  CHECK(announced(scratch, end_record64(100'001)) == 100'001);
}

TEST_CASE("what is no archive announces nothing") {
  const Scratch scratch;
  for (const std::string& bytes : {std::string(), std::string("text"), std::string(200'000, 'x'),
                                   end_record(1).substr(0, 12)}) {
    CHECK_FALSE(announced(scratch, bytes));
  }
}
