#include "master/base/archive/entry_name.h"

#include "master/base/archive/unpacked_archive.h"
#include "tests/master/base/archive/support.h"

using namespace stride;
using namespace stride::tests;

TEST_CASE("a name that is no UTF-8 is one of CP437, or of Windows-1252") {
  CHECK(archive::entry_name("resources/data.csv") == "resources/data.csv");
  CHECK(archive::entry_name("Größe.fmu") == "Größe.fmu");
  CHECK(archive::entry_name("Gr\x94\xe1"
                            "e.fmu") == "Größe.fmu");
  CHECK(archive::entry_name("Gr\xf6\xdf"
                            "e.fmu") == "Größe.fmu");
  CHECK(archive::entry_name("a\xa4o.fmu") == "año.fmu");
  CHECK(archive::entry_name("a\xf1o.fmu") == "año.fmu");
}

TEST_CASE("an archive whose names are in another code page is unpacked to names in UTF-8") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {{"resources/Gr__e.txt", "hallo"}});
  std::string bytes = read(path);
  const std::string code_page = GENERATE("\x94\xe1", "\xf6\xdf");
  std::size_t places = 0;
  for (std::size_t at = bytes.find("__"); at != bytes.npos; at = bytes.find("__")) {
    bytes.replace(at, 2, code_page);
    ++places;
  }
  CHECK(places == 2);
  const archive::UnpackedArchive unpacked(scratch.write("other.fmu", bytes), "a unit");
  CHECK(read(unpacked.folder() / "resources/Größe.txt") == "hallo");
}

TEST_CASE("a name of Windows is one with folders, and cannot lead out of the archive's folder") {
  CHECK(archive::entry_name("binaries\\linux64\\x.so") == "binaries/linux64/x.so");
  CHECK(archive::entry_name("resources/a\\b") == "resources/a\\b");
  const Scratch scratch;
  const auto packed =
      make_zip(scratch / "a.fmu", {{"a\\", ""}, {"a\\b\\", ""}, {"a\\b\\c", "hallo"}});
  CHECK(read(archive::UnpackedArchive(packed, "a unit").folder() / "a/b/c") == "hallo");
  const auto path = make_zip(scratch / "unit.fmu", {{"..\\x.txt", "hallo"}});
  CHECK_THAT(input_error([&] { archive::UnpackedArchive(path, "a unit"); }),
             Catch::Matchers::Contains("leads out of the archive's folder"));
}

TEST_CASE("a name in another code page cannot lead out of the archive's folder") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {{"../__.txt", "hallo"}});
  std::string bytes = read(path);
  for (std::size_t at = bytes.find("__"); at != bytes.npos; at = bytes.find("__")) {
    bytes.replace(at, 2, "\x94\xe1");
  }
  CHECK_THAT(
      input_error([&] { archive::UnpackedArchive(scratch.write("other.fmu", bytes), "a unit"); }),
      Catch::Matchers::Contains("leads out of the archive's folder"));
}
