#include "master/observe/recorders/junit.h"

#include <limits>

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

core::Verdict failed_check() {
  core::Verdict verdict{"voltage", false, "1.5 V; expected >= 1.8 V", "always", {"x.ssd", 7}};
  verdict.time = Time(1500ms);
  core::ValueBlock value(core::ValueType::Float64, 1);
  value.numbers<double>()[0] = 1.5;
  verdict.values.push_back({"sensor.voltage", value, "V"});
  verdict.margin = {-std::numeric_limits<double>::infinity(), "", Time(1500ms)};
  return verdict;
}

core::Verdict fine_check() {
  core::Verdict verdict{"fine", true, "", "final"};
  verdict.margin = {0.1, "V", Time(2s)};
  return verdict;
}

JunitReport report() {
  JunitReport made;
  made.suite = "approach";
  made.host = "bench";
  made.began = std::chrono::system_clock::time_point(std::chrono::seconds(1'700'000'000));
  made.wall_time = 1250ms;
  made.properties = {{"stop", "30"}};
  return made;
}

std::string written(const JunitReport& report) {
  const TemporaryFolder folder;
  write_junit(folder / "junit.xml", report);
  return content(folder / "junit.xml");
}

}  // namespace

TEST_CASE("a test case for the run, for each unit's verdict and for each check") {
  const std::vector<core::Verdict> verdicts = {{"judge", false, "too late"},
                                               {"led", std::nullopt, "no \"run\"", "count"},
                                               failed_check(),
                                               fine_check()};
  JunitReport full = report();
  full.verdicts = verdicts;
  CHECK(written(full) == R"(<?xml version="1.0" encoding="UTF-8"?>
<testsuites>
    <testsuite name="approach" package="" id="0" tests="5" failures="2" errors="0" skipped="1" time="1.250" timestamp="2023-11-14T22:13:20" hostname="bench">
        <properties>
            <property name="stop" value="30"/>
            <property name="margin: voltage" value="-inf"/>
            <property name="margin: fine" value="0.1 V"/>
        </properties>
        <testcase name="run" classname="approach" time="1.250"/>
        <testcase name="judge" classname="approach.units" time="0.000">
            <failure message="too late" type="verdict">judge
too late
</failure>
        </testcase>
        <testcase name="led" classname="approach.checks" time="0.000">
            <skipped message="undecided: no &quot;run&quot;"/>
        </testcase>
        <testcase name="voltage" classname="approach.checks" time="0.000">
            <failure message="at 1.5 s: 1.5 V; expected &gt;= 1.8 V" type="always">x.ssd:7: voltage
first failure: 1.5 s
1.5 V; expected &gt;= 1.8 V
sensor.voltage = 1.5 V
</failure>
        </testcase>
        <testcase name="fine" classname="approach.checks" time="0.000"/>
        <system-out/>
        <system-err/>
    </testsuite>
</testsuites>
)");
}

TEST_CASE("a run that did not come to its end is an error, whose first line is the message") {
  JunitReport broken = report();
  broken.error = "unit 'a' crashed\n  hint: look at <its> log";
  const std::string text = written(broken);
  CHECK_THAT(text, Contains("tests=\"1\" failures=\"0\" errors=\"1\""));
  CHECK_THAT(text, Contains("<error message=\"unit &apos;a&apos; crashed\" type=\"run\">unit "
                            "'a' crashed\n  hint: look at &lt;its&gt; log</error>"));
}

TEST_CASE("a file that cannot be written is an error of the option that names it") {
  CHECK_THAT(error_of([] { write_junit("/nowhere/junit.xml", report()); }),
             Contains("/nowhere/junit.xml") && Contains("the folder of this file does not exist"));
}
