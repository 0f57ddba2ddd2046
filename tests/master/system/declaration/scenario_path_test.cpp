#include "master/system/declaration/scenario_path.h"

#include <catch2/catch.hpp>

#include "tests/error_of.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

/// As a folder of scenarios has them, and two that are none.
class Scenarios {
 public:
  Scenarios() {
    for (const char* file : {"near/near.ssd", "far/far.ssd", "far/far.xosc", "empty/other.ssd"}) {
      fs::create_directories((folder_ / file).parent_path());
      folder_.write(file, "");
    }
    folder_.write("README.md", "");
  }
  fs::path path() const { return folder_ / ""; }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("the scenarios of a folder are known by its folders' names") {
  const Scenarios scenarios;
  CHECK(scenario_names(scenarios.path()) == std::vector<std::string>{"far", "near"});
  CHECK(scenario_names(scenarios.path() / "nothing").empty());
}

TEST_CASE("a name leads to the scenario's file") {
  const Scenarios scenarios;
  const fs::path file = scenarios.path() / "near" / "near.ssd";
  CHECK(named_scenario("near", scenarios.path()) == file);
}

TEST_CASE("what has a folder or an ending, or is there, is a path") {
  const Scenarios scenarios;
  for (const char* path : {"near.ssd", "./near", "near/", "/near", "nothing.fmu", ".", ".."}) {
    INFO(path);
    CHECK_FALSE(named_scenario(path, scenarios.path()));
    CHECK_NOTHROW(refuse_unknown_name(path, scenarios.path()));
  }
  const fs::path before = fs::current_path();
  fs::current_path(scenarios.path());
  CHECK_FALSE(named_scenario("near", scenarios.path()));
  CHECK_NOTHROW(refuse_unknown_name("near", scenarios.path()));
  fs::current_path(before);
}

TEST_CASE("an unknown name is answered with what could be meant") {
  const Scenarios scenarios;
  const auto answer = [&](const char* name) {
    return error_of([&] { refuse_unknown_name(name, scenarios.path()); });
  };
  CHECK_FALSE(named_scenario("nearr", scenarios.path()));
  CHECK(answer("nearr") ==
        "there is no file 'nearr', and no scenario of this name comes with stride\n"
        "  hint: did you mean 'near'?");
  CHECK_THAT(answer("something"), Contains("hint: known are: far, near"));
  CHECK_THAT(
      error_of([&] { refuse_unknown_name("far", scenarios.path() / "nothing"); }),
      Contains(
          "hint: name a system file (.ssd), a package (.ssp), an FMU (.fmu) or a table (.csv)"));
}
