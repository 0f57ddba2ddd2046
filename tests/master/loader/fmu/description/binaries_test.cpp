#include "master/loader/fmu/description/binaries.h"

#include <cctype>

#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string find_error(const Scratch& scratch, const std::string& version) {
  return input_error([&] {
    importer::find_library(scratch.path(), version, "tank", {.where = {"system.ssd", 4}});
  });
}

}  // namespace

TEST_CASE("the library of an FMU is in the folder of this platform, by its version's name") {
  const Scratch scratch;
  const std::string fmi3 = std::string("binaries/") + importer::platform() + "/tank.so";
  const std::string fmi2 = std::string("binaries/") + importer::fmi2_platform() + "/tank.so";
  scratch.write(fmi3, "");
  scratch.write(fmi2, "");
  for (const auto& [version, path] : {std::pair("3.0", fmi3), std::pair("2.0", fmi2)}) {
    const importer::FoundLibrary found = importer::find_library(scratch.path(), version, "tank");
    CHECK(found.path == scratch / path);
    CHECK(found.warning.empty());
  }
}

TEST_CASE("a library that is not named as it should be is found where it cannot be another one") {
  const auto [folder, name] =
      GENERATE(table<std::string, std::string>({{importer::platform(), "Tank.so"},
                                                {importer::platform(), "tank-2.so"},
                                                {importer::fmi2_platform(), "tank.so"},
                                                {importer::fmi2_platform(), "TANK.so"}}));
  const Scratch scratch;
  const std::string path = "binaries/" + folder + "/" + name;
  scratch.write(path, "");
  scratch.write("binaries/" + folder + "/notes.txt", "");
  const importer::FoundLibrary found = importer::find_library(scratch.path(), "3.0", "tank");
  CHECK(found.path == scratch / path);
  CHECK_THAT(found.warning,
             Contains("its library is '" + path + "'") &&
                 Contains("expected 'binaries/" + std::string(importer::platform()) + "/tank.so'"));
}

TEST_CASE("of several libraries the one of the name is the unit's, or none") {
  const Scratch scratch;
  const std::string folder = std::string("binaries/") + importer::platform() + "/";
  scratch.write(folder + "helper.so", "");
  scratch.write(folder + "TANK.so", "");
  CHECK(importer::find_library(scratch.path(), "3.0", "tank").path ==
        scratch / (folder + "TANK.so"));
  CHECK_THAT(input_error([&] { importer::find_library(scratch.path(), "3.0", "other"); }),
             Contains("other.so' is missing") && Contains("modelIdentifier") &&
                 Contains("there are 'TANK.so', 'helper.so'"));
}

TEST_CASE("the error of an FMU for other platforms lists them") {
  const Scratch scratch;
  CHECK_THAT(find_error(scratch, "3.0"), Contains("system.ssd:4: unit 'tank': ") &&
                                             Contains("it has none at all") &&
                                             Contains("export the unit for this platform"));
  scratch.write("binaries/x86_64-windows/tank.dll", "");
  scratch.write("binaries/riscv64-linux/tank.so", "");
  CHECK_THAT(find_error(scratch, "3.0"), Contains("it has riscv64-linux, x86_64-windows") &&
                                             Contains("hint: export the unit for this platform"));
}

TEST_CASE("an FMU for Windows, or for 32 bits, cannot be loaded") {
  const Scratch windows;
  windows.write("binaries/win32/tank.dll", "");
  windows.write("binaries/win64/tank.dll", "");
  CHECK_THAT(
      find_error(windows, "2.0"),
      Contains("it has win32, win64") && Contains("a Windows library cannot be loaded on Linux"));
  const Scratch narrow;
  narrow.write("binaries/linux32/tank.so", "");
  CHECK_THAT(find_error(narrow, "2.0"), Contains("it has linux32") && Contains("64-bit Linux"));
}

TEST_CASE("the error of a source-code FMU has the way to compile it") {
  const Scratch scratch;
  scratch.write("sources/tank.c", "");
  CHECK_THAT(find_error(scratch, "2.0"), Contains("it has its source code only") &&
                                             Contains("stride build FILE.fmu -o BUILT.fmu") &&
                                             Contains("linux64/tank.so'"));
  CHECK_THAT(find_error(scratch, "3.0"), Contains("-linux/tank.so', in a copy"));
}

TEST_CASE("the folder of this platform may be written in another case") {
  const Scratch scratch;
  std::string folder = importer::fmi2_platform();
  folder[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(folder[0])));
  const std::string path = "binaries/" + folder + "/tank.so";
  scratch.write(path, "");
  const importer::FoundLibrary found = importer::find_library(scratch.path(), "2.0", "tank");
  CHECK(found.path == scratch / path);
  CHECK_THAT(found.warning, Contains("its library is '" + path + "'"));
}

TEST_CASE("the folder of the libraries may be in another one, with a warning") {
  const Scratch scratch;
  const std::string path = std::string("x/binaries/") + importer::platform() + "/tank.so";
  scratch.write(path, "");
  const importer::FoundLibrary found = importer::find_library(scratch.path(), "3.0", "tank");
  CHECK(found.path == scratch / path);
  CHECK_THAT(found.warning, Contains("its library is '" + path + "'"));
}

TEST_CASE("the error of a missing library names the component, or else the model") {
  const Scratch scratch;
  const auto error = [&](const core::Context& user) {
    return input_error([&] { importer::find_library(scratch.path(), "3.0", "tank", user); });
  };
  CHECK_THAT(error({.unit = "left"}), Contains("unit 'left': "));
  CHECK_THAT(error({}), Contains("unit 'tank': "));
}
