// Scenarios that come with stride, by their names; the wheel's test and the installed tree's run
// one.
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

TEST_CASE("a command takes the name of a scenario for its file") {
  const Scratch scratch;
  const Outcome components =
      run_program({"reference", "components", "nfc_approach"}, scratch.path());
  CHECK(components.exit_code == 0);
  CHECK(components.out == "world\nenvironment\nchannel\nreader\nsensor\nground_truth\n");
  CHECK_THAT(run_program({"reference", "scenarios"}).out,
             Contains("nfc_approach\n") && Contains("nfc_far\n") && !Contains("README"));
}

TEST_CASE("an unknown name of a scenario is answered with the nearest one, or the file beside it") {
  const Workspace workspace(two_filters());
  for (const char* command : {"run", "check"}) {
    CHECK(input_error_of(workspace.stride({command, "nfc_aproach"})) ==
          "stride: error: there is no file 'nfc_aproach', and no scenario of this name comes with "
          "stride\n  hint: did you mean 'nfc_approach'?\n");
  }
  CHECK_THAT(input_error_of(workspace.stride({"run", "test"})),
             Contains("did you mean 'test.ssd'?"));
  CHECK_THAT(input_error_of(workspace.stride({"run", "nowhere/nfc_approach"})),
             Contains("nowhere/nfc_approach") && !Contains("comes with stride"));
}

TEST_CASE("a scenario that comes with stride is not completed in its place") {
  const Scratch scratch;
  CHECK_THAT(input_error_of(run_program({"complete", "nfc_approach"}, scratch.path())),
             Contains("nfc_approach.ssd: this scenario comes with stride, and is not changed\n"
                      "  hint: name the file to be written with --output"));
}
