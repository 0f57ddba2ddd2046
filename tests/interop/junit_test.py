"""junit_test.py STRIDE FOLDER: junitparser reads what `stride run --junit` writes, as continuous integration does, and
the report keeps to the rules of Ant's JUnit schema, the strictest that is about. Results go into FOLDER."""

import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import junitparser

SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="2.0" name="judged"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="judged">
    <ssd:Elements><ssd:Component name="filter" source="minimal.fmu"/></ssd:Elements>
  </ssd:System>
  <ssd:DefaultExperiment stopTime="1"/>
  <ssd:Annotations><ssc:Annotation type="org.stride"><stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
    <stride:Checks>
      <stride:Always name="good &lt;&amp;&gt;" signal="filter.y" max="1"/>
      <stride:Never name="bad" signal="filter.y" above="0.5"/>
      <stride:Always name="open" signal="filter.y" from="0.1001" to="0.1002" min="0.9"/>
    </stride:Checks>
  </stride:Scenario></ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>
"""
SUITE_ATTRIBUTES = {"name", "timestamp", "hostname", "tests", "failures", "errors", "time", "id", "package"}
SUITE_CHILDREN = re.compile(r"properties (testcase )*system-out system-err ")
CASE_CHILDREN = re.compile(r"((skipped|error|failure) )?")


def require(condition, what):
    if not condition:
        raise AssertionError(what)


def run(program, folder, name, *options):
    scenario = folder / f"{name}.ssd"
    scenario.write_text(SCENARIO if name == "judged" else SCENARIO.replace("minimal.fmu", "nobody.fmu"), encoding="utf-8")
    report = folder / f"{name}.xml"
    command = [program, "run", scenario, "--quiet", "--out", folder / name, "--junit", report, *options]
    return subprocess.run(command, check=False, capture_output=True).returncode, report


def words(element):
    return "".join(f"{child.tag} " for child in element)


def check_structure(report):
    root = ElementTree.parse(report).getroot()
    require(root.tag == "testsuites" and len(root) == 1, "one test suite in <testsuites>")
    suite = root[0]
    require(SUITE_ATTRIBUTES <= set(suite.attrib), f"a test suite has {sorted(suite.attrib)}")
    require(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d", suite.get("timestamp")), suite.get("timestamp"))
    require(SUITE_CHILDREN.fullmatch(words(suite)), words(suite))
    for name in ("time", "tests", "failures", "errors", "skipped"):
        require(float(suite.get(name)) >= 0, f"{name} is {suite.get(name)}")
    cases = suite.findall("testcase")
    require(int(suite.get("tests")) == len(cases), "the tests are counted")
    for count, kind in (("failures", "failure"), ("errors", "error"), ("skipped", "skipped")):
        require(int(suite.get(count)) == len(suite.findall(f"testcase/{kind}")), f"{count} are counted")
    for case in cases:
        require({"name", "classname", "time"} <= set(case.attrib), f"a test case has {sorted(case.attrib)}")
        require(CASE_CHILDREN.fullmatch(words(case)), words(case))
        for bad in case.findall("failure") + case.findall("error"):
            require(bad.get("type") and bad.get("message") and bad.text, f"{case.get('name')} says what and why")
    require(len({(case.get("classname"), case.get("name")) for case in cases}) == len(cases), "names are unique")


def read(report):
    (suite,) = junitparser.JUnitXml.fromfile(str(report))
    return suite, {case.name: case for case in suite}


def check_judged(program, folder):
    status, report = run(program, folder, "judged", "--set", "filter.u=1", "--set", "filter.time_constant=0.1")
    require(status == 1, f"the exit code is {status}")
    check_structure(report)
    suite, cases = read(report)
    require((suite.tests, suite.failures, suite.errors, suite.skipped) == (4, 1, 0, 1), "counts")
    require(cases["run"].is_passed and cases["good <&>"].is_passed, "what is good has passed")
    require(cases["open"].is_skipped, "what is undecided is skipped")
    (failure,) = cases["bad"].result
    require(isinstance(failure, junitparser.Failure) and failure.message.startswith("at 0.07 s: 0.5"), failure.message)
    require("filter.y = 0.5" in failure.text, failure.text)
    require({each.name: each.value for each in suite.properties()}["outcome"] == "completed", "properties")


def check_not_loaded(program, folder):
    status, report = run(program, folder, "unknown")
    require(status == 2, f"the exit code is {status}")
    check_structure(report)
    suite, cases = read(report)
    (error,) = cases["run"].result
    require(suite.errors == 1 and isinstance(error, junitparser.Error) and "nobody.fmu" in error.message, error.message)


def main(program, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    check_judged(program, folder)
    check_not_loaded(program, folder)


if __name__ == "__main__":
    main(*sys.argv[1:])
