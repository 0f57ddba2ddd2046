#include "master/fmi/library.h"

#include "tests/master/fmi/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using fmi::Library;

namespace {

std::string load_error(const fs::path& path) {
  return input_error([&] { Library(path, {"system.ssd", 3}); });
}

}  // namespace

TEST_CASE("a unit of the kit has the whole table and describes itself") {
  const Library library(STRIDE_TYPES_LIBRARY);
  const fmi::Functions& fmi = library.functions();
#define STRIDE_CHECK(name) CHECK(fmi.name != nullptr);
  FMI3_FUNCTIONS(STRIDE_CHECK)
#undef STRIDE_CHECK
  CHECK(std::string(fmi.GetVersion()) == "3.0");
  CHECK(library.describes_itself());
  CHECK_THAT(library.describe({}), Contains("modelIdentifier=\"types\""));
}

TEST_CASE("functions of other interface types may be missing") {
  const Library library(raw_library("raw"));
  CHECK(library.functions().DoStep != nullptr);
  CHECK(library.functions().SetContinuousStates == nullptr);
  CHECK(library.functions().ActivateModelPartition == nullptr);
  CHECK_FALSE(library.describes_itself());
  CHECK_THAT(input_error([&] { library.describe({}); }),
             Contains("does not know its own model description"));
}

TEST_CASE("a missing Co-Simulation function is named") {
  CHECK_THAT(load_error(raw_library("raw_without_do_step")),
             Contains("system.ssd:3: ") && Contains("does not export fmi3DoStep, "));
}

TEST_CASE("a missing shared library is named") {
  CHECK_THAT(load_error(raw_library("raw_with_missing_library")),
             Contains("needs the shared library 'libstride_test_absent.so', which was not found") &&
                 Contains("hint: install the package"));
}

TEST_CASE("an undefined symbol is named") {
  CHECK_THAT(load_error(raw_library("raw_with_undefined_symbol")),
             Contains("needs the symbol 'stride_test_nobody_has_this', which no library"));
}

TEST_CASE("what is no library for this machine is an error") {
  const Scratch scratch;
  CHECK_THAT(load_error(scratch.write("text.so", "this is no library, whatever its name says")),
             Contains("text.so' cannot be loaded") && Contains(fmi::platform()));
  CHECK_THAT(load_error(scratch / "absent.so"), Contains("absent.so' cannot be loaded"));
}

TEST_CASE("a unit that cannot describe itself gives the reason") {
  CHECK_THAT(input_error([&] { Library(STRIDE_STATELESS_LIBRARY).describe({}); }),
             Contains("cannot describe itself: its resource note.txt is missing"));
}

TEST_CASE("the library of an FMU stands in the folder of this platform") {
  const Scratch scratch;
  const std::string own = std::string("binaries/") + fmi::platform() + "/tank.so";
  scratch.write(own, "");
  CHECK(fmi::find_library(scratch.path(), "tank") == scratch / own);
  CHECK_THAT(input_error([&] { fmi::find_library(scratch.path(), "other"); }),
             Contains("other.so' is missing") && Contains("modelIdentifier"));
}

TEST_CASE("an FMU for other platforms says which") {
  const Scratch scratch;
  CHECK_THAT(input_error([&] { fmi::find_library(scratch.path(), "tank"); }),
             Contains("it has none at all") && Contains("source-code FMU"));
  scratch.write("binaries/x86_64-windows/tank.dll", "");
  scratch.write("binaries/riscv64-linux/tank.so", "");
  CHECK_THAT(input_error([&] { fmi::find_library(scratch.path(), "tank"); }),
             Contains("it has riscv64-linux, x86_64-windows"));
}

TEST_CASE("the resource path is absolute and ends with the separator") {
  const Scratch scratch;
  fs::create_directories(scratch / "resources");
  const std::string expected = (scratch / "resources").string() + "/";
  CHECK(fmi::resource_path(scratch / "resources") == expected);
  CHECK(fmi::resource_path(scratch / "x/../resources/") == expected);
  CHECK(fmi::resource_path(scratch / "absent") == "");
  CHECK(fmi::resource_path("") == "");
}
