// Arrays whose sizes structural parameters give.
#include "master/importer/unpacked_fmu.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// `first` amplifies its input, `second` amplifies that.
Workspace two_amplifiers() {
  return Workspace(Parts{component("first", "resizable.fmu") + component("second", "resizable.fmu"),
                         connection("first.y", "second.u")});
}

Arguments with(std::initializer_list<std::string> settings) {
  Arguments arguments{"--stop", "0.01"};
  for (const std::string& setting : settings) {
    arguments.push_back("--set");
    arguments.push_back(setting);
  }
  return arguments;
}

}  // namespace

TEST_CASE("a structural parameter gives arrays their size, before anything else is set") {
  const Workspace workspace = two_amplifiers();
  const Outcome outcome =
      workspace.run(with({"second.gain=1 10 100", "first.u=2 3 4", "first.gain=1 2 3", "first.n=3",
                          "second.n=2", "second.n=3"}));
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Csv signals = workspace.signals();
  for (const auto& [name, value] : {std::pair{"second.y[1]", 2.0}, std::pair{"second.y[2]", 60.0},
                                    std::pair{"second.y[3]", 1200.0}}) {
    CHECK(signals.numbers(name).front() == value);
    CHECK(signals.numbers(name).back() == value);
  }
  CHECK_FALSE(signals.has("second.y[4]"));
}

TEST_CASE("an array of no element is one") {
  const Workspace workspace = two_amplifiers();
  const Outcome outcome = workspace.run(with({"first.n=0", "second.n=0"}));
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_FALSE(workspace.signals().has("second.y[1]"));
}

TEST_CASE("arrays that do not fit each other are an error, with the sizes that were set") {
  const Workspace workspace = two_amplifiers();
  const Outcome outcome = workspace.run(with({"first.n=3"}));
  CHECK_THAT(input_error_of(outcome),
             Contains(workspace.at("startElement=\"first\"")) &&
                 Contains("'first.y' to 'second.u'") &&
                 Contains("an array of 3 elements and an array of 2 elements"));
}

TEST_CASE("values are as many as the size that was set, which is within its bounds") {
  const Workspace workspace = two_amplifiers();
  CHECK_THAT(input_error_of(workspace.run(with({"first.n=3", "second.n=3", "first.gain=1 2"}))),
             Contains("expected 3 Float64 values"));
  CHECK_THAT(input_error_of(workspace.run(with({"first.n=17"}))),
             Contains("17 is out of range, expected at most 16"));
  CHECK_THAT(input_error_of(workspace.run(with({"first.n=-1"}))),
             Contains("expected a UInt64 number"));
}

TEST_CASE("more columns than a table can have are refused before the run") {
  const Workspace workspace(Parts{component("large", "unit")});
  const stride::importer::UnpackedFmu unpacked(test_fmu("resizable"));
  fs::copy(unpacked.folder(), workspace / "unit", fs::copy_options::recursive);
  std::string text = read(unpacked.folder() / "modelDescription.xml");
  const std::string bound = "max=\"16\"";
  workspace.scratch().write("unit/modelDescription.xml",
                            text.replace(text.find(bound), bound.size(), "max=\"2000000\""));
  CHECK_THAT(
      input_error_of(workspace.run(with({"large.n=1000001"}))),
      Contains("have 1000001 columns") && Contains("1000000 at most") && Contains("--signals"));
  CHECK_FALSE(fs::exists(workspace / "out"));
}
