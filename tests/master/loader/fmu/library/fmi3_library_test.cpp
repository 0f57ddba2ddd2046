#include "master/loader/fmu/library/fmi3_library.h"

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using importer::Fmi3Library;

namespace {

std::string load_error(const fs::path& path) {
  return input_error([&] { Fmi3Library(path, "", {"system.ssd", 3}); });
}

}  // namespace

TEST_CASE("a unit of the kit has the whole table and describes itself") {
  const Fmi3Library library(unit_library("types"));
  const importer::Fmi3Functions& fmi = library.functions();
#define STRIDE_CHECK(name) CHECK(fmi.name != nullptr);
  FMI3_FUNCTIONS(STRIDE_CHECK)
#undef STRIDE_CHECK
  CHECK(std::string(fmi.GetVersion()) == "3.0");
  CHECK(library.describes_itself());
  CHECK_THAT(library.describe({}), Contains("modelIdentifier=\"types\""));
}

TEST_CASE("functions of other interface types may be missing") {
  const Fmi3Library library(raw_library("raw"));
  CHECK(library.functions().DoStep != nullptr);
  CHECK(library.functions().SetContinuousStates == nullptr);
  CHECK(library.functions().ActivateModelPartition == nullptr);
  CHECK_FALSE(library.describes_itself());
  CHECK_THAT(input_error([&] { library.describe({}); }), Contains("contains no model description"));
}

TEST_CASE("a missing Co-Simulation function is named") {
  CHECK_THAT(load_error(raw_library("raw_without_do_step")),
             Contains("system.ssd:3: ") && Contains("does not export fmi3DoStep, "));
}

TEST_CASE("a unit that cannot describe itself gives the reason") {
  CHECK_THAT(input_error([&] { Fmi3Library(unit_library("stateless")).describe({}); }),
             Contains("cannot describe itself: its resource note.txt is missing"));
}

TEST_CASE("the resource path is absolute and ends with the separator") {
  const Scratch scratch;
  fs::create_directories(scratch / "resources");
  const std::string expected = (scratch / "resources").string() + "/";
  CHECK(importer::resource_path(scratch / "resources") == expected);
  CHECK(importer::resource_path(scratch / "x/../resources/") == expected);
  CHECK(importer::resource_path(scratch / "absent") == "");
  CHECK(importer::resource_path("") == "");
}
