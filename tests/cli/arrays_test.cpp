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

namespace {

/// An FMU of FMI 2.0 with the scalars u[1] and y[1], `y` being `u` at once.
void write_scalars(const Workspace& workspace, const std::string& folder) {
  const stride::importer::UnpackedFmu unpacked(test_fmu("fmi2_types"));
  fs::copy(unpacked.folder(), workspace / folder, fs::copy_options::recursive);
  std::string text = read(unpacked.folder() / "modelDescription.xml");
  for (const auto& [name, other] :
       {std::pair{"\"real\"", "\"u[1]\""}, std::pair{"\"real.echo\"", "\"y[1]\""}}) {
    text.replace(text.find(name), std::string(name).size(), other);
  }
  workspace.scratch().write(folder + "/modelDescription.xml", text);
}

}  // namespace

TEST_CASE("elements of arrays are connected one by one, and check says which are not") {
  const Workspace workspace(
      Parts{component("first", "resizable.fmu") + component("second", "resizable.fmu"),
            connection("first.y[2]", "second.u[1]") + connection("first.y[1]", "second.u[3]")});
  const std::initializer_list<std::string> settings{"first.u=2 3", "second.n=4",
                                                    "second.u=10 20 30 40", "second.gain=1 1 1 1"};
  const Outcome outcome = workspace.run(with(settings));
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Csv signals = workspace.signals();
  for (const auto& [name, value] :
       {std::pair{"second.y[1]", 3.0}, std::pair{"second.y[2]", 20.0},
        std::pair{"second.y[3]", 2.0}, std::pair{"second.y[4]", 40.0}}) {
    CHECK(signals.numbers(name).front() == value);
    CHECK(signals.numbers(name).back() == value);
  }
  const Outcome checked = workspace.stride({"check", "test.ssd", "--set", "second.n=4"});
  CAPTURE(checked.err);
  CHECK_THAT(checked.out, Contains("first.y[2]  second.u[1]  Float64") &&
                              Contains("Elements without connection, which keep their start "
                                       "values\n  second.u: u[2], u[4]\n"));
}

TEST_CASE("bounds are those of the sizes that were set") {
  const Workspace workspace(
      Parts{component("first", "resizable.fmu") + component("second", "resizable.fmu"),
            connection("first.y[3]", "second.u[1]")});
  CHECK(workspace.run(with({"first.n=3", "first.gain=1 1 1"})).exit_code == 0);
  CHECK_THAT(input_error_of(workspace.run(with({}))),
             Contains(workspace.at("startElement=\"first\"")) &&
                 Contains("unit 'first', variable 'y[3]': 'y' is an array of 2 elements, and the "
                          "index 3 in [3] is not from 1 to 2"));
}

TEST_CASE("an array of FMI 3.0 is connected to scalars of FMI 2.0, and these to an array") {
  const Workspace workspace(
      Parts{component("first", "resizable.fmu") + component("old", "scalars") +
                component("second", "resizable.fmu"),
            connection("first.y", "old.u") + connection("old.y", "second.u")});
  write_scalars(workspace, "scalars");
  const Outcome outcome = workspace.run(with(
      {"first.n=1", "second.n=1", "first.u=2", "first.gain=3", "old.gain=1", "second.gain=5"}));
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(workspace.signals().numbers("second.y[1]").back() == 30);
  CHECK_THAT(input_error_of(workspace.run(with({"second.n=1"}))),
             Contains("cannot connect 'first.y' to 'old.u"));
}
