#include "master/system/declaration/annotation.h"

#include <catch2/catch.hpp>

#include "master/system/declaration/scenario.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;

namespace {

std::string annotations(const std::string& inside) {
  return "<ssd:Annotations>\n<ssc:Annotation type='org.stride'>" + inside +
         "</ssc:Annotation></ssd:Annotations>";
}

std::string scenario_element(const std::string& inside) {
  return "<stride:Scenario xmlns:stride='urn:org.stride:scenario:1'>" + inside +
         "</stride:Scenario>";
}

std::string at_root(const std::string& inside) {
  return ssd(
      "<ssd:System name='s'><ssd:Elements><ssd:Component name='a' "
      "source='a.fmu'/></ssd:Elements></ssd:System>" +
      inside);
}

ScenarioAnnotation read_annotation(const std::string& text) {
  const TemporaryFolder folder;
  return read_scenario(folder.write("x.ssd", text)).annotation;
}

std::string annotation_error(const std::string& inside) {
  return error_of([&] { read_annotation(at_root(annotations(scenario_element(inside)))); });
}

}  // namespace

TEST_CASE("All elements and attributes of the annotation") {
  const ScenarioAnnotation annotation = read_annotation(at_root(
      annotations(scenario_element("<stride:Step size='0.001'/>"
                                   "<stride:Record signals=' sensor.*  channel.distance'/>\n"
                                   "<stride:Record signals='reader.*'/>"
                                   "<stride:Plot title='Both' signals='a.x  b.*'/>"
                                   "<stride:Plot title='One' signals='a.y'/>"
                                   "<stride:TerminalConnection startElement='a' "
                                   "startTerminal='P' endElement='b' endTerminal='Q.R'/>"
                                   "<stride:Results signals='s.csv' events='none' "
                                   "report='none'/>"
                                   "<stride:MainThread components='plant legacy.*'/>"
                                   "<stride:EarlyReturn components='* x' allowed='false'/>"
                                   "<stride:EarlyReturn components='a' allowed='true'/>"
                                   "<stride:StateSaving components='a' allowed='false'/>"
                                   "<stride:StateSaving components='b c' eachStep='true'/>"
                                   "<stride:Host components='a x.*' timeout='0.5'/>\n"
                                   "<stride:Host components='b' process='true' "
                                   "memoryLimit='512' sandbox='false' snapshots='false'/>"
                                   "<stride:Host components='c' process='false'/>"
                                   "<stride:IdleSkip maxSkip='2'/>"
                                   "<stride:IdleSkip components='a b' enabled='false'/>"
                                   "<stride:Deadband variable='a.u' value='0'/>"
                                   "<stride:Tolerance variable='a.y' value='1e-3'/>"))));
  CHECK(annotation.step.size == Duration(1'000'000'000));
  REQUIRE(annotation.record.size() == 3);
  CHECK(annotation.record[0].text == "sensor.*");
  CHECK(annotation.record[1].text == "channel.distance");
  CHECK(annotation.record[1].where.line == 4);
  CHECK(annotation.record[2].text == "reader.*");
  CHECK(annotation.record[2].where.line == 5);
  REQUIRE(annotation.plots.size() == 2);
  CHECK(annotation.plots[0].title == "Both");
  REQUIRE(annotation.plots[0].signals.size() == 2);
  CHECK(annotation.plots[0].signals[1].text == "b.*");
  CHECK(annotation.plots[0].signals[1].where.line == 5);
  CHECK(annotation.plots[1].title == "One");
  REQUIRE(annotation.terminals.size() == 1);
  CHECK(annotation.terminals[0].start_element == "a");
  CHECK(annotation.terminals[0].start_terminal == "P");
  CHECK(annotation.terminals[0].end_element == "b");
  CHECK(annotation.terminals[0].end_terminal == "Q.R");
  CHECK(annotation.terminals[0].where.line == 5);
  REQUIRE(annotation.main_thread.size() == 2);
  CHECK(annotation.main_thread[0].text == "plant");
  CHECK(annotation.main_thread[1].text == "legacy.*");
  CHECK(annotation.main_thread[1].where.line == 5);
  REQUIRE(annotation.early_return.size() == 3);
  CHECK(annotation.early_return[0].components.text == "*");
  CHECK_FALSE(annotation.early_return[1].allowed);
  CHECK(annotation.early_return[2].components.text == "a");
  REQUIRE(annotation.hosts.rules.size() == 4);
  CHECK(annotation.hosts.rules[1].components.text == "x.*");
  CHECK(annotation.hosts.rules[1].components.where.line == 5);
  CHECK(annotation.hosts.rules[1].settings.process == true);
  CHECK(annotation.hosts.rules[1].settings.call_limit == std::chrono::milliseconds(500));
  CHECK(annotation.hosts.rules[1].settings.memory_limit == std::nullopt);
  CHECK(annotation.hosts.rules[1].settings.sandbox == std::nullopt);
  CHECK(annotation.hosts.rules[2].components.where.line == 6);
  CHECK(annotation.hosts.rules[2].settings.memory_limit == 512U << 20);
  CHECK(annotation.hosts.rules[2].settings.sandbox == false);
  CHECK(annotation.hosts.rules[2].settings.snapshots == false);
  CHECK(annotation.hosts.rules[3].settings.process == false);
  REQUIRE(annotation.idle.rules.size() == 3);
  CHECK(annotation.idle.rules[0].components.text == "*");
  CHECK(annotation.idle.rules[0].max_skip == Duration(2'000'000'000'000));
  CHECK(annotation.idle.rules[0].enabled);
  CHECK(annotation.idle.rules[2].components.text == "b");
  CHECK_FALSE(annotation.idle.rules[2].enabled);
  CHECK(annotation.idle.deadbands.at(0).variable == "a.u");
  CHECK(annotation.idle.tolerances.at(0).value == 1e-3);
  CHECK(annotation.early_return[2].components.where.line == 5);
  REQUIRE(annotation.state_saving.size() == 1);
  CHECK_FALSE(annotation.state_saving[0].allowed);
  REQUIRE(annotation.repeated_steps.size() == 2);
  CHECK(annotation.repeated_steps[1].components.text == "c");
  CHECK_FALSE(annotation.repeated_steps[1].allowed);
  CHECK(annotation.early_return[2].allowed);
  CHECK(annotation.results.signals == "s.csv");
  CHECK(annotation.results.events.empty());
  CHECK(annotation.results.trace == "signals.vcd");
  CHECK(annotation.results.activity == "activity.csv");
  CHECK(annotation.results.statistics == "run.json");
  CHECK(annotation.results.report.empty());
}

TEST_CASE("Everything about the stepping can be chosen") {
  const StepSettings step =
      read_annotation(
          at_root(annotations(scenario_element(
              "<stride:Step policy='error-controlled' size='0.01' maximum='0.1' minimum='1e-6' "
              "relativeTolerance='1e-4' absoluteTolerance='0'/>"
              "<stride:Exchange coupling='gauss-seidel' extrapolation='quadratic'/>"))))
          .step;
  core::RunOptions options;
  step.apply(options);
  CHECK(options.step.policy == &core::kErrorControlledSteps);
  CHECK(options.step.size == std::chrono::milliseconds(10));
  CHECK(options.step.maximum == Duration(std::chrono::milliseconds(100)));
  CHECK(options.step.minimum == std::chrono::microseconds(1));
  CHECK(options.step.relative_tolerance == 1e-4);
  CHECK(options.step.absolute_tolerance == 0);
  CHECK(options.coupling == core::Coupling::GaussSeidel);
  CHECK(options.extrapolation == core::Extrapolation::Quadratic);
}

TEST_CASE("It may be left out, or be at the system") {
  CHECK(read_annotation(at_root("")).step.size == std::nullopt);
  CHECK(read_annotation(at_root("")).results.signals == "signals.csv");
  CHECK(read_annotation(at_root(annotations(scenario_element("")))).record.empty());
  CHECK(read_annotation(ssd_with("<ssd:Component name='a' source='a.fmu'/>",
                                 annotations(scenario_element("<stride:Step size='1e-6'/>"))))
            .step.size == Duration(1'000'000));
}

TEST_CASE("A mistake in the annotation is named with its line") {
  CHECK_THAT(annotation_error("<stride:Stpe size='1'/>"),
             Contains("x.ssd:4: <stride:Stpe> is not known in <stride:Scenario>") &&
                 Contains("did you mean 'Step'?"));
  CHECK_THAT(annotation_error("<stride:Policy/>"),
             Contains("known are: Step, Exchange, Record, Checks, Coverage, "
                      "Results, Plot, MainThread, EarlyReturn, …"));
  CHECK_THAT(annotation_error("<stride:Step siez='1'/>"), Contains("did you mean 'size'?"));
  CHECK_THAT(annotation_error("<stride:Step size=''/>"),
             Contains("the attribute 'size' of <stride:Step> is empty"));
  CHECK_THAT(annotation_error("<stride:Step size='1 ms'/>"),
             Contains("size: '1 ms' is not a number"));
  CHECK_THAT(annotation_error("<stride:Step maximum='0'/>"),
             Contains("maximum: a step must be above 0 s"));
  CHECK_THAT(annotation_error("<stride:Step size='1e-13'/>"),
             Contains("size: '1e-13' is not 0 s and less than 1 ps, the resolution of times"));
  CHECK_THAT(annotation_error("<stride:Results signals='units'/>"),
             Contains("signals=\"units\" is the name of a folder of the results"));
  CHECK_THAT(annotation_error("<stride:Step policy='fixt'/>"),
             Contains("policy: unknown value 'fixt'; did you mean 'fixed'?"));
  CHECK_THAT(annotation_error("<stride:Step relativeTolerance='-1'/>"),
             Contains("relativeTolerance: '-1' is not a number of at least 0"));
  CHECK_THAT(annotation_error("<stride:Exchange coupling='x'/>"), Contains("jacobi, gauss-seidel"));
  CHECK_THAT(annotation_error("<stride:Step size='1'/><stride:Step size='1'/>"),
             Contains("a second <stride:Step>"));
  CHECK_THAT(annotation_error("<stride:Record signal='a'/>"), Contains("did you mean 'signals'?"));
  CHECK_THAT(annotation_error("<stride:EarlyReturn components='a'/>"), Contains("'allowed'"));
  CHECK_THAT(annotation_error("<stride:EarlyReturn allowed='false'/>"), Contains("'components'"));
  CHECK_THAT(annotation_error("<stride:EarlyReturn components='a' allowed='no'/>"),
             Contains("x.ssd:4: ") &&
                 Contains("allowed=\"no\" of <stride:EarlyReturn>: expected true or false"));
  CHECK_THAT(annotation_error("<stride:Host process='true'/>"), Contains("'components'"));
  CHECK_THAT(annotation_error("<stride:Host components='a' memory='1'/>"),
             Contains("known are: components, process, timeout, memoryLimit, sandbox, "
                      "snapshots"));
  CHECK_THAT(annotation_error("<stride:Host components='a' process='yes'/>"),
             Contains("process=\"yes\" of <stride:Host>: expected true or false"));
  CHECK_THAT(annotation_error("<stride:Host components='a' timeout='0'/>"),
             Contains("x.ssd:4: ") && Contains("timeout: a time limit must be above 0 s"));
  CHECK_THAT(annotation_error("<stride:Host components='a' memoryLimit='1.5'/>"),
             Contains("memoryLimit: '1.5' is not a whole number of MiB; expected at least 1"));
  CHECK_THAT(annotation_error("<stride:Host components='a' process='false' timeout='5'/>"),
             Contains("x.ssd:4: ") && Contains("timeout is for a unit with a process of its own"));
  CHECK_THAT(annotation_error("<stride:IdleSkip maxSkip='0'/>"),
             Contains("x.ssd:4: ") && Contains("maxSkip: a skip must be above 0 s"));
  CHECK_THAT(annotation_error("<stride:Deadband variable='a.u' value='-1'/>"),
             Contains("of at least 0"));
  CHECK_THAT(annotation_error("<stride:Tolerance variable='a.y' value='0'/>"), Contains("above 0"));
  CHECK_THAT(annotation_error("<stride:Tolerance value='1'/>"), Contains("'variable'"));
  CHECK_THAT(annotation_error("<stride:Results csv='a'/>"),
             Contains("known are: signals, events, trace, activity, statistics, report"));
  CHECK_THAT(annotation_error("<stride:Plot signals='a'/>"), Contains("'title'"));
  CHECK_THAT(annotation_error("<stride:Plot title='A'/>"), Contains("'signals'"));
  CHECK_THAT(annotation_error("<stride:Plot title='A' signals=' '/>"),
             Contains("x.ssd:4: ") && Contains("the plot shows nothing"));
  CHECK_THAT(annotation_error("<stride:Results trace='../a.vcd'/>"),
             Contains("is not a plain file name"));
  CHECK_THAT(annotation_error("<stride:Results trace='run.json'/>"),
             Contains("two results have the file name 'run.json'"));
}

TEST_CASE("The components of a step in the singular are answered with the attribute") {
  CHECK_THAT(annotation_error("<stride:Step component='a' size='0.1'/>"),
             Contains("<stride:Step> has no attribute 'component'") &&
                 Contains("did you mean 'components'?"));
}

TEST_CASE("An annotation that was meant to be ours is not ignored") {
  const auto error = [](const std::string& type, const std::string& inside) {
    return error_of([&] {
      read_annotation(at_root("<ssd:Annotations>\n<ssc:Annotation type='" + type + "'>" + inside +
                              "</ssc:Annotation></ssd:Annotations>"));
    });
  };
  for (const char* type : {"org.strid", "org.Stride", "com.example"}) {
    CHECK_THAT(error(type, scenario_element("")), Contains("x.ssd:4") &&
                                                      Contains("so it would be ignored") &&
                                                      Contains("write type=\"org.stride\""));
  }
  CHECK_THAT(error("org.strde", "<other/>"), Contains("so it would be ignored"));
  CHECK_THAT(
      error_of([&] {
        read_annotation(at_root("<ssd:Annotations><ssd:Annotation type='org.stride'>" +
                                scenario_element("") + "</ssd:Annotation></ssd:Annotations>"));
      }),
      Contains("so it would be ignored") && Contains("write <ssc:Annotation>"));
  CHECK_NOTHROW(
      read_annotation(at_root("<ssd:Annotations><ssc:Annotation "
                              "type='com.example'><x/></ssc:Annotation></ssd:Annotations>")));
}

TEST_CASE("An annotation without content, in another place, or twice is refused") {
  CHECK_THROWS_WITH(
      read_annotation(at_root(annotations(""))),
      Contains("holds no <stride:Scenario>") && Contains("urn:org.stride:scenario:1"));
  CHECK_THROWS_WITH(
      read_annotation(at_root(annotations("<s:Scenario xmlns:s='urn:org.stride:scenario:2'/>"))),
      Contains("<s:Scenario> is in the namespace 'urn:org.stride:scenario:2'"));
  CHECK_THROWS_WITH(
      read_annotation(ssd_with("<ssd:Component name='a' source='a.fmu'>" +
                               annotations(scenario_element("")) + "</ssd:Component>")),
      Contains("x.ssd:6: an annotation of the type 'org.stride' does not belong here"));
  CHECK_THROWS_WITH(
      read_annotation(
          ssd("<ssd:System name='s'><ssd:Elements><ssd:Component name='a' source='a.fmu'/>"
              "</ssd:Elements>" +
              annotations(scenario_element("")) + "</ssd:System>\n" +
              annotations(scenario_element("")))),
      Contains("x.ssd:6: a second annotation of the type 'org.stride'; the first is in line 4"));
}
