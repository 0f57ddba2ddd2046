"""slurm_test.py STRIDE UNITS FOLDER: cases of a campaign run on a Slurm cluster of one node, which is started for it, and
their table is that of a local run, also if jobs are cancelled on the way. Exit code 77 if Slurm is not installed."""

import csv
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

import slurm_node

SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="2.0" name="filters"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="filters">
    <ssd:Elements>
      <ssd:Component name="first" source="minimal.fmu"/><ssd:Component name="second" source="minimal.fmu"/>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="first" startConnector="y" endElement="second" endConnector="u"/>
    </ssd:Connections>
  </ssd:System>
  <ssd:DefaultExperiment stopTime="1"/>
  <ssd:Annotations><ssc:Annotation type="org.stride"><stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
    <stride:Host components="second"/>
    <stride:Checks><stride:Always name="bounded" signal="first.y" max="1"/></stride:Checks>
  </stride:Scenario></ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>
"""
CAMPAIGN = """<OpenSCENARIO>
  <FileHeader revMajor="1" revMinor="1" date="2026-01-01T00:00:00" author="" description=""/>
  <ParameterValueDistribution>
    <ScenarioFile filepath="filters.ssd"/>
    <Stochastic numberOfTestRuns="{cases}" randomSeed="1">
      <StochasticDistribution parameterName="first.u">
        <UniformDistribution><Range lowerLimit="0" upperLimit="2"/></UniformDistribution>
      </StochasticDistribution>
    </Stochastic>
  </ParameterValueDistribution>
  <stride:Campaign xmlns:stride="urn:org.stride:campaign:1">
    <stride:Keep results="none"/>
    <stride:Aggregate name="end" signal="second.y" function="final"/>
    <stride:Limit wallTime="60"/>
  </stride:Campaign>
</OpenSCENARIO>
"""
MOST_JOBS = 6
CLUSTER = f"MaxArraySize={MOST_JOBS}\nLicenses=simulator:1"


def require(condition, what):
    if not condition:
        raise AssertionError(what)


class Campaign:
    """A folder with a campaign, whose name has what shells and Slurm would replace."""

    def __init__(self, program, units, folder, cases):
        self.folder = folder / f"{cases} an engineer's $HOME %j"
        self.folder.mkdir()
        (self.folder / "filters.ssd").write_text(SCENARIO, encoding="utf-8")
        (self.folder / "c.xosc").write_text(CAMPAIGN.format(cases=cases), encoding="utf-8")
        self._program = program
        self._environment = {**os.environ, "STRIDE_UNITS": str(units)}

    def stride(self, expected, *arguments, environment=None):
        """What it prints: all of it."""
        result = subprocess.run([self._program, "campaign", *arguments], cwd=self.folder, text=True, check=False,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120,
                                env={**(environment or os.environ), "STRIDE_UNITS": self._environment["STRIDE_UNITS"]})
        require(result.returncode == expected, f"stride campaign {arguments}: {result.returncode}\n{result.stdout}")
        return result.stdout

    def submit(self, node, expected, out, *options):
        return self.stride(expected, "submit", "c.xosc", "--on", "slurm", "--out", out, *options,
                           environment=node.environment)

    def table(self, out):
        """Without the wall times, when and where."""
        with open(self.folder / out / "cases.csv", encoding="utf-8", newline="") as file:
            return [row[:-3] for row in csv.reader(file)]

    def records(self, out):
        return sorted((self.folder / out / "cases").rglob("*.json"))


def array_in(text):
    return re.search(r"as job (\d+)", text).group(1)


def check_array(node, campaign):
    """An array with the most jobs that there may be."""
    options = ("--partition", "test", "--time", "5", "--licenses", "simulator:1", "--sbatch=--nice=10", "--sbatch", "mem=0")
    script = campaign.submit(node, 0, "cluster", "--dry-run", *options)
    require(not (campaign.folder / "cluster").exists(), "a dry run writes something")
    printed = campaign.submit(node, 1, "cluster", "--wait", *options)
    name = array_in(printed)
    require("40 of 40 cases are missing" in printed and "an array of 6 jobs with up to 7" in printed, printed)
    require(re.search(r"c: 40 of 40 cases done, \d+ passed, \d+ failed, 0 missing", printed), printed)
    require(campaign.table("cluster") == campaign.table("local"), "another table than that of a local run")
    kept = campaign.folder / "cluster/slurm" / f"{name}.sh"
    require(kept.read_text(encoding="utf-8") == script, "another script than that of the dry run")
    for line in ("#SBATCH --partition=test", "#SBATCH --time=5", "#SBATCH --licenses=simulator:1", "#SBATCH --nice=10",
                 "#SBATCH --mem=0", "  0-6 7-13 14-20 21-27 28-34 35-39"):
        require(f"\n{line}\n" in script, f"there is no line '{line}' in\n{script}")
    logs = {file.name for file in kept.parent.glob("*.log")}
    require(logs == {f"{name}_{i}.log" for i in range(MOST_JOBS)}, f"log files {logs}")
    require("all of 40 cases are done" in campaign.submit(node, 0, "cluster"), "cases are submitted that are done")
    require(" failures\n" in campaign.submit(node, 1, "cluster", "--wait"), "failures are not shown again")
    check_by_hand(node, campaign, kept)


def check_by_hand(node, campaign, script):
    """What is submitted again runs what is missing; nothing of the submission's surroundings is needed."""
    lost = campaign.records("cluster")[5:8]
    for record in lost:
        record.unlink()
    times = {record: record.stat().st_mtime_ns for record in campaign.records("cluster")}
    environment = {name: node.environment[name] for name in ("PATH", "SLURM_CONF")}
    subprocess.run(["sbatch", "--wait", script], check=False, cwd="/", env=environment, stdout=subprocess.DEVNULL, timeout=60)
    require(all(record.exists() for record in lost), "a script that was submitted by hand has not run all cases")
    require(all(record.stat().st_mtime_ns == times[record] for record in times), "a case was repeated")


def check_mistakes(node, campaign):
    for expected, options, text in (
            (1, ("--partition", "nowhere"), "sbatch of Slurm has failed"),
            (2, ("--time", "1"), "--time 1 is 60 s, and by its Limit wallTime a case may take 60 s"),
            (2, ("--time", "soon"), "--time soon: this is no time of Slurm"),
            (2, ("--chunk", "2"), "--chunk 2: that makes 20 jobs, and an array may have 6"),
            (2, ("--sbatch", "array=0-3"), "--sbatch cannot give 'array'")):
        printed = campaign.submit(node, expected, "wrong", *options)
        require(text in printed, f"{options}: {printed}")
        require(not campaign.records("wrong"), "a case was run")


def end_jobs(node, array, *options):
    subprocess.run(["scancel", *options, array], env=node.environment, check=True)
    node.wait_for(lambda: array not in node.ask("squeue", "--noheader", "--format=%F"), "jobs go on")


def check_cancelled(node, campaign):
    """A part of the cases is lost, and none is judged by the end of its job. A license keeps jobs from being too many."""
    slow = ("--jobs", "2", "--licenses", "simulator:1")
    array = array_in(campaign.submit(node, 0, "cut", *slow))
    node.wait_for(lambda: len(campaign.records("cut")) >= 5, "there are no records")
    require("are in the queue of Slurm still" in campaign.submit(node, 2, "cut"), "cases are submitted twice")
    end_jobs(node, array)
    require(not list((campaign.folder / "cut").glob("running/*")), "cancelled jobs leave files")
    before = len(campaign.records("cut"))
    array = array_in(campaign.submit(node, 0, "cut", *slow, "--chunk", "100"))
    node.wait_for(lambda: len(campaign.records("cut")) >= before + 5, "there are no further records")
    end_jobs(node, array, "--signal=KILL", "--full")
    records = campaign.records("cut")
    require(10 <= len(records) < len(campaign.table("local")) - 1, f"{len(records)} cases were run before jobs were ended")
    outcomes = {json.loads(record.read_text(encoding="utf-8"))["outcome"] for record in records}
    require(outcomes <= {"passed", "failed"}, f"cases of cancelled jobs are {outcomes}")
    status = campaign.stride(0, "status", "cut")
    require(f"{len(records)} of " in status, status)
    printed = campaign.submit(node, 1, "cut", "--wait", "--time", "10", "--chunk", "60")
    require(array_in(printed) != array and " jobs with up to 60\n" in printed, printed)
    require(campaign.table("cut") == campaign.table("local"), "another table than that of a local run")


def check_without_slurm(campaign):
    environment = {name: value for name, value in os.environ.items() if name != "PATH"}
    printed = campaign.stride(2, "submit", "c.xosc", "--on", "slurm", environment={**environment, "PATH": "/nowhere"})
    require("there are no programs of Slurm here" in printed, printed)


def main(program, units, folder):
    missing = slurm_node.missing_programs()
    if missing:
        print(f"SKIPPED: Slurm is not installed ({', '.join(missing)})")
        return 1 if os.environ.get("CI") == "true" else 77
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # by way of what ends the daemons
    folder = pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    few, many = (Campaign(program, units, folder, cases) for cases in (40, 200))
    for campaign in (few, many):
        campaign.stride(1, "run", "c.xosc", "--out", "local", "--quiet")
    check_without_slurm(few)
    # the paths of sockets are short
    with tempfile.TemporaryDirectory(prefix="slurm") as place, slurm_node.SlurmNode(place, CLUSTER) as node:
        check_array(node, few)
        check_mistakes(node, few)
        check_cancelled(node, many)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
