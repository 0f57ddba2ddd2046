// Arrays whose sizes structural parameters give.
#include "master/loader/fmu/library/unpacked_fmu.h"
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

// ---- Start values of elements ----

namespace {

/// Where `second` amplifies its start values alone, by 1 if nothing else is set; the system may
/// have connectors, and values that are bound to it.
class OneAmplifier : public Workspace {
 public:
  explicit OneAmplifier(const std::string& connectors = "", const std::string& connections = "",
                        const std::string& values = "")
      : Workspace(text(connectors, connections)) {
    write_scalars(*this, "scalars");
    scratch().write("values.ssv",
                    "<ssv:ParameterSet version=\"2.0\" name=\"p\" "
                    "xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\">"
                    "<ssv:Parameters>" +
                        values + "</ssv:Parameters></ssv:ParameterSet>");
  }

 private:
  static std::string text(const std::string& connectors, const std::string& connections) {
    std::string text = scenario_text(
        Parts{component("second", "resizable.fmu") + component("old", "scalars"), connections});
    return text.insert(text.find("<ssd:Elements>"),
                       "<ssd:Connectors>" + connectors +
                           "</ssd:Connectors>\n<ssd:ParameterBindings><ssd:ParameterBinding "
                           "source=\"values.ssv\"/></ssd:ParameterBindings>\n");
  }
};

std::string float_connector(const std::string& name, const std::string& dimension = "") {
  return "<ssd:Connector name=\"" + name + "\" kind=\"input\"><ssc:Float64/>" + dimension +
         "</ssd:Connector>\n";
}

std::string from_root(const std::string& connector, const std::string& component,
                      const std::string& end) {
  return "<ssd:Connection startConnector=\"" + connector + "\" endElement=\"" + component +
         "\" endConnector=\"" + end + "\"/>\n";
}

std::string float_value(const std::string& name, const std::string& value) {
  return "<ssv:Parameter name=\"" + name + "\"><ssv:Float64 value=\"" + value +
         "\"/></ssv:Parameter>";
}

/// The outputs of `second` at the start and at the end, where they are the same.
std::vector<double> amplified(const Workspace& workspace, const Outcome& outcome,
                              std::size_t count) {
  CAPTURE(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const Csv signals = workspace.signals();
  std::vector<double> values;
  for (std::size_t i = 1; i <= count; ++i) {
    const auto column = signals.numbers("second.y[" + std::to_string(i) + "]");
    CHECK(column.front() == column.back());
    values.push_back(column.back());
  }
  return values;
}

using Numbers = std::vector<double>;

}  // namespace

TEST_CASE("--set of elements goes with the size that the same command sets") {
  const OneAmplifier workspace;
  CHECK(amplified(workspace,
                  workspace.run(with({"second.u[3]=5", "second.gain[3]=2", "second.n=4",
                                      "second.gain=1 1 1 1", "second.u[1]=7"})),
                  4) == Numbers{7, 0, 5, 0});
  CHECK(amplified(workspace, workspace.run(with({"second.u=1 2", "second.gain[2]=3"})), 2) ==
        Numbers{1, 6});
  CHECK_THAT(input_error_of(workspace.run(with({"second.u[3]=5"}))),
             Contains("--set second.u[3]=5: unit 'second', variable 'u[3]': 'u' is an array of 2 "
                      "elements, and the index 3 in [3] is not from 1 to 2"));
  CHECK_THAT(input_error_of(workspace.run(with({"second.n=3", "second.u[0]=5"}))),
             Contains("an array of 3 elements") && Contains("indices start at 1"));
}

TEST_CASE("values of a set are for elements, and wrong indices an error with its file") {
  const OneAmplifier workspace("", "",
                               float_value("second.u[2]", "5") + float_value("second.no[2]", "6"));
  const Outcome outcome = workspace.run(with({}));
  CHECK(amplified(workspace, outcome, 2) == Numbers{0, 5});
  CHECK_THAT(outcome.err, Contains("stride: warning: values.ssv:1: unit 'second', variable "
                                   "'no[2]': its model 'resizable' has no such variable"));
  CHECK_THAT(
      input_error_of(workspace.run(with({"second.n=1", "second.gain=1"}))),
      Contains("values.ssv:1: unit 'second', variable 'u[2]': 'u' is an array of 1 element,"));
}

TEST_CASE("a start value of a system's connector reaches the element that it leads to") {
  const OneAmplifier workspace(
      float_connector("i") + float_connector("j") +
          float_connector("k", "<ssc:Dimension size=\"1\"/>"),
      from_root("i", "second", "u[3]") + from_root("j", "second", "u[1]") +
          from_root("k", "old", "u"),
      float_value("i", "7") + float_value("j", "8") + float_value("k", "9"));
  const Outcome outcome = workspace.run(with({"second.n=3", "second.gain=1 1 1", "old.gain=1"}));
  CHECK(amplified(workspace, outcome, 3) == Numbers{8, 0, 7});
  CHECK_THAT(outcome.err, !Contains("warning"));
  CHECK(workspace.signals().numbers("old.y[1]").back() == 9);
  const Outcome small = workspace.run(with({}));
  CHECK_THAT(input_error_of(small),
             Contains(workspace.at("startConnector=\"i\"") + "unit 'second', variable 'u[3]': 'u' "
                                                             "is an array of 2 elements"));
}

TEST_CASE("the dimensions of a system's connector are those of what it is connected to") {
  const OneAmplifier workspace(float_connector("k", "<ssc:Dimension size=\"3\"/>"),
                               from_root("k", "second", "u"));
  CHECK(workspace.run(with({"second.n=3", "second.gain=1 1 1"})).exit_code == 0);
  CHECK_THAT(input_error_of(workspace.run(with({}))),
             Contains(workspace.at("<ssd:Connector name=\"k\"") +
                      "the connector 'k' of a system has the dimensions 3, and 'second.u', which "
                      "it is connected to, is an array of 2 elements"));
}
