"""ucis_test.py STRIDE FOLDER: PyUCIS reads the coverage that `stride coverage --ucis` writes, and finds each bin with its
count; the document keeps to the schema of UCIS. Results go into FOLDER."""

import json
import pathlib
import shutil
import subprocess
import sys

from ucis.cover_type_t import CoverTypeT
from ucis.scope_type_t import ScopeTypeT
from ucis.xml import validate_ucis_xml
from ucis.xml.xml_reader import XmlReader

SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="2.0" name="covered"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="covered">
    <ssd:Elements>
      <ssd:Component name="ticker" source="ticker.fmu"/><ssd:Component name="listener" source="listener.fmu"/>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="ticker" startConnector="tick.clock" endElement="listener" endConnector="message.clock"/>
      <ssd:Connection startElement="ticker" startConnector="tick.number" endElement="listener" endConnector="message.number"/>
    </ssd:Connections>
  </ssd:System>
  <ssd:DefaultExperiment stopTime="1"/>
  <ssd:Annotations><ssc:Annotation type="org.stride"><stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
    <stride:Coverage>
      <stride:Group component="ticker" goal="90.5">
        <stride:Values name="level" signal="level" min="0" max="4" bins="4"/>
        <stride:Ignore point="level" bins="[3, 4]"/>
        <stride:Values name="height&lt;&amp;>" signal="level" edges="0 1 3"/>
        <stride:Cross name="both" of="level height&lt;&amp;>"/>
      </stride:Group>
      <stride:Group component="listener">
        <stride:Words name="numbers" event="message.number"/>
        <stride:Gaps name="gaps" event="message.number"/>
      </stride:Group>
    </stride:Coverage>
  </stride:Scenario></ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>
"""
BINS = CoverTypeT.CVGBIN | CoverTypeT.IGNOREBIN


def require(condition, what):
    if not condition:
        raise AssertionError(what)


def command(*arguments):
    subprocess.run(arguments, check=True)


def written(report):
    """{(component, point): {bin: (count, is_ignored)}} of coverage.json, of all points that have a bin."""
    return {(group["component"], point["name"]):
            {bin["name"]: (bin["count"], bin.get("ignored", False)) for bin in point["bins"]}
            for group in report["groups"] for point in group["points"] if point["bins"]}


def found(document):
    """The same, as PyUCIS has it. Of crosses it does not tell which bins are ignored."""
    bins = {}
    for instance in XmlReader().read(str(document)).scopes(ScopeTypeT.INSTANCE):
        for group in instance.scopes(ScopeTypeT.COVERGROUP):
            for point in group.scopes(ScopeTypeT.COVERPOINT | ScopeTypeT.CROSS):
                bins[instance.getScopeName(), point.getScopeName()] = {
                    item.getName(): (item.getCoverData().data, item.getCoverData().type == CoverTypeT.IGNOREBIN)
                    for item in point.coverItems(BINS)}
    return bins


def check(program, folder):
    scenario = folder / "covered.ssd"
    scenario.write_text(SCENARIO, encoding="utf-8")
    command(program, "run", scenario, "--quiet", "--out", folder / "results")
    document = folder / "coverage.xml"
    command(program, "coverage", folder / "results", "--ucis", document)
    with document.open(encoding="utf-8") as file:
        validate_ucis_xml(file)
    ours = written(json.loads((folder / "results/coverage.json").read_text(encoding="utf-8")))
    theirs = found(document)
    require(theirs.keys() == ours.keys(), f"PyUCIS has the points {sorted(theirs)}, expected {sorted(ours)}")
    for name, bins in ours.items():
        counts = {bin: count for bin, (count, _) in theirs[name].items()}
        require(counts == {bin: count for bin, (count, _) in bins.items()}, f"{name}: {theirs[name]}, expected {bins}")
        if name[1] != "both":
            require(theirs[name] == bins, f"{name}: {theirs[name]}, expected {bins}")
    require(sum(count for bins in ours.values() for count, _ in bins.values()) > 20, "hardly anything was covered")


def main(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    check(program, folder)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve())
