"""slurm_test.py STRIDE UNITS FOLDER: cases of a campaign, and of a search, run on a Slurm cluster of one node, which is
started for it, and their table is that of a local run, also if jobs are cancelled on the way. Exit code 77 if Slurm is not
installed."""

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
import time

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
SEARCHED = """<OpenSCENARIO>
  <FileHeader revMajor="1" revMinor="1" date="2026-01-01T00:00:00" author="" description=""/>
  <ParameterValueDistribution>
    <ScenarioFile filepath="filters.ssd"/>
    <Stochastic numberOfTestRuns="10" randomSeed="1">
      <StochasticDistribution parameterName="first.u">
        <UniformDistribution><Range lowerLimit="0" upperLimit="1.2"/></UniformDistribution>
      </StochasticDistribution>
      <StochasticDistribution parameterName="first.time_constant">
        <UniformDistribution><Range lowerLimit="0.5" upperLimit="2"/></UniformDistribution>
      </StochasticDistribution>
    </Stochastic>
  </ParameterValueDistribution>
  <stride:Campaign xmlns:stride="urn:org.stride:campaign:1"><stride:Keep results="none"/></stride:Campaign>
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
        (self.folder / "s.xosc").write_text(SEARCHED, encoding="utf-8")
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

    def start(self, *arguments, environment):
        """Without waiting for its end."""
        return subprocess.Popen([self._program, "campaign", *arguments], cwd=self.folder, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT,
                                env={**environment, "STRIDE_UNITS": self._environment["STRIDE_UNITS"]})

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
    require("40 of 40 cases missing" in printed and "an array of 6 jobs with up to 7" in printed, printed)
    require(re.search(r"c: 40 of 40 cases done, \d+ passed, \d+ failed, 0 missing", printed), printed)
    require(campaign.table("cluster") == campaign.table("local"), "another table than that of a local run")
    kept = campaign.folder / "cluster/slurm" / f"{name}.sh"
    require(kept.read_text(encoding="utf-8") == script, "another script than that of the dry run")
    for line in ("#SBATCH --partition=test", "#SBATCH --time=5", "#SBATCH --licenses=simulator:1", "#SBATCH --nice=10",
                 "#SBATCH --mem=0", "  0-6 7-13 14-20 21-27 28-34 35-39"):
        require(f"\n{line}\n" in script, f"there is no line '{line}' in\n{script}")
    logs = {file.name for file in kept.parent.glob("*.log")}
    require(logs == {f"{name}_{i}.log" for i in range(MOST_JOBS)}, f"log files {logs}")
    require("40 of 40 cases done" in campaign.submit(node, 0, "cluster"), "cases are submitted that are done")
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


def search_words(out, *options):
    return ("search", "s.xosc", "--out", out, "--progress", "none", *options)


def on_slurm(*options):
    return ("--on", "slurm", "--jobs", "2", *options)


def printed_of(text):
    """Without where it is."""
    return re.search(r"^s: .*?\nTable in ", text, re.DOTALL | re.MULTILINE).group()


def scripts_of(folder):
    """Of what was submitted, in that order."""
    return sorted(folder.glob("slurm/[0-9]*.sh"), key=lambda path: int(path.stem))


def check_search(node, campaign):
    """The same cases and words as those of a local search."""
    local = campaign.stride(1, *search_words("here"))
    script = campaign.stride(0, *search_words("there", *on_slurm("--dry-run")), environment=node.environment)
    require(not (campaign.folder / "there").exists(), "a dry run writes something")
    require("--jobs 2 --cases " in script and "\n  0\n" in script, script)
    printed = campaign.stride(1, *search_words("there", *on_slurm()), environment=node.environment)
    require(printed_of(printed) == printed_of(local), f"another search than the local one:\n{printed}\n{local}")
    require("Scripts and log files in there/slurm\n" in printed, printed)
    require(campaign.table("there") == campaign.table("here"), "another table than that of a local search")
    scripts = scripts_of(campaign.folder / "there")
    require(scripts[0].read_text(encoding="utf-8") == script, "another script than that of the dry run")
    require("\n  1-2 3-4 5-6 7-8\n" in scripts[1].read_text(encoding="utf-8"), "the first generation has other jobs")


def start_held(node, campaign, out):
    """A search whose jobs wait in the queue until they are released."""
    return campaign.start(*search_words(out, *on_slurm("--sbatch", "hold")), environment=node.environment)


def release(node, script):
    subprocess.run(["scontrol", "release", script.stem], env=node.environment, check=True)


def is_locked(folder):
    return folder.exists() and f":{folder.stat().st_ino} " in pathlib.Path("/proc/locks").read_text(encoding="utf-8")


def check_ended_search(node, campaign):
    """Jobs are in the queue when the search is killed, and when it is interrupted: they go on, and so does the search."""
    folder = campaign.folder / "ended"
    search = start_held(node, campaign, "ended")
    node.wait_for(lambda: scripts_of(folder), "nothing is submitted")
    search.kill()
    search.communicate(timeout=60)
    node.wait_for(lambda: not is_locked(folder), "the search goes on")
    search = start_held(node, campaign, "ended")
    node.wait_for(lambda: is_locked(folder), "the search does not go on")
    time.sleep(1)
    search.send_signal(signal.SIGINT)
    printed = search.communicate(timeout=60)[0]
    require("the search was interrupted; 0 of at most 200 cases are done" in printed, printed)
    job = scripts_of(folder)[0]
    require(f"job {job.stem} of Slurm is in the queue still; the same command waits for it" in printed, printed)

    search = campaign.start(*search_words("ended", *on_slurm()), environment=node.environment)
    node.wait_for(lambda: is_locked(folder), "the search does not go on")
    time.sleep(1)
    require(scripts_of(folder) == [job], "what is in the queue is submitted again")
    release(node, job)
    printed = search.communicate(timeout=60)[0]
    require(search.returncode == 1, printed)
    require(campaign.table("ended") == campaign.table("here"), "another table than that of a local search")
    require(len(scripts_of(folder)) == len(scripts_of(campaign.folder / "there")), "a generation is submitted twice")


def check_lost_jobs(node, campaign):
    """Jobs that end without a record end the search, which does not submit them again by itself."""
    folder = campaign.folder / "lost"
    search = start_held(node, campaign, "lost")
    node.wait_for(lambda: scripts_of(folder), "nothing is submitted")
    end_jobs(node, scripts_of(folder)[0].stem)
    printed = search.communicate(timeout=60)[0]
    require(search.returncode == 1 and "jobs have left the queue of Slurm, and case 0 has no record" in printed, printed)
    require("they have no log files, so they were cancelled before they began" in printed, printed)

    scenario = campaign.folder / "filters.ssd"
    search = start_held(node, campaign, "lost")
    node.wait_for(lambda: len(scripts_of(folder)) == 2, "nothing is submitted again")
    scenario.rename(campaign.folder / "away")
    release(node, scripts_of(folder)[1])
    printed = search.communicate(timeout=60)[0]
    (campaign.folder / "away").rename(scenario)
    require(search.returncode == 1 and "case 0 has no record; a log file ends with: " in printed, printed)
    require(re.search(r"see lost/slurm/\d+_0.log; the same command submits these cases again", printed), printed)
    require(len(scripts_of(folder)) == 2, "jobs are submitted again and again")
    campaign.stride(1, *search_words("lost", *on_slurm()), environment=node.environment)
    require(campaign.table("lost") == campaign.table("here"), "another table than that of a local search")


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
        check_search(node, few)
        check_ended_search(node, few)
        check_lost_jobs(node, few)
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
