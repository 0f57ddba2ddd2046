#include "master/loader/fmu/library/fmi2_library.h"

#include "master/loader/fmu/fmu.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string load_error(const std::string& name) {
  const auto fmu = importer::Fmu::load(test_fmu(name), {"system.ssd", 3});
  return input_error([&] { fmu->load_library(); });
}

}  // namespace

TEST_CASE("a unit's functions are found") {
  const auto fmu = importer::Fmu::load(test_fmu("fmi2_relaxation"));
  const auto library = fmu->load_fmi2_library();
  REQUIRE(library);
  CHECK(fmu->load_library() == library);
  CHECK_FALSE(fmu->load_fmi3_library());
  CHECK(std::string(library->functions().GetVersion()) == "2.0");
  CHECK(library->functions().DoStep != nullptr);
  CHECK(library->functions().GetFMUstate != nullptr);
  CHECK(library->functions().SetContinuousStates == nullptr);
  const auto fmi3 = importer::Fmu::load(test_fmu("types"));
  CHECK_FALSE(fmi3->load_fmi2_library());
}

TEST_CASE("a missing function is named") {
  CHECK_THAT(load_error("fmi2_without_do_step"),
             Contains("system.ssd:3: ") &&
                 Contains("does not export fmi2DoStep, which an FMI 2.0") &&
                 Contains("hint: export it with C linkage"));
}

TEST_CASE("functions with the prefix of a static library are found, too") {
  const auto fmu = importer::Fmu::load(test_fmu("fmi2_with_prefix"));
  const auto library = fmu->load_fmi2_library();
  CHECK(library->functions().DoStep != nullptr);
  CHECK(library->functions().Terminate != nullptr);
  CHECK(library->prefix() == "fmi2_with_prefix_");
  CHECK(importer::Fmu::load(test_fmu("fmi2_relaxation"))->load_library()->prefix() == "");
}

TEST_CASE("a library of other platform types is refused") {
  CHECK_THAT(load_error("fmi2_of_other_platform"),
             Contains("the platform types 'other'; expected 'default'"));
}

TEST_CASE("a library need not have functions for types that its unit does not have") {
  const auto fmu = importer::Fmu::load(test_fmu("fmi2_without_strings"));
  CHECK(fmu->load_library());
  CHECK_THAT(load_error("fmi2_types_without_strings"),
             Contains("does not export fmi2GetString, fmi2SetString, by which its outputs are read "
                      "and its inputs set"));
}

TEST_CASE("a function that a library does not have is named where it is called") {
  const auto fmu = importer::Fmu::load(test_fmu("fmi2_without_strings"));
  const auto unit = make_unit(fmu, "unit");
  core::ValueBlock text(core::ValueType::String, 1);
  const core::ValueReference first = 0;
  unit->enter_initialization({}, std::nullopt);
  CHECK_THAT(run_error([&] {
               unit->get({&first, 1}, text);
             }),
             Contains("its library does not export fmi2GetString"));
}
