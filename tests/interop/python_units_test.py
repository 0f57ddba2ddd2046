"""python_units_test.py STRIDE UNITS FOLDER: the models of python_units/, made into FMUs of FMI 2.0 and 3.0 by PythonFMU and
PythonFMU3, run in stride together with each other and with units of our own (in UNITS). Each table has the bits of
reference_master.py. Results go into FOLDER."""

import json
import math
import os
import pathlib
import sys
import sysconfig

import pythonfmu.builder
import pythonfmu3.builder
from reference_master import Master
from stride_run import RunFailed, System, differences, read_table, run_system

MODELS = pathlib.Path(__file__).parent / "python_units"
VERSIONS = ("fmi2", "fmi3")


def python_library():
    """Units of PythonFMU are not linked with Python's library, and expect it in the process."""
    return pathlib.Path(sysconfig.get_config_var("LIBDIR")) / sysconfig.get_config_var("INSTSONAME")


def skipped_without_python_library():
    """Says so, and returns the exit code, if the library is not there; CI must have it."""
    if python_library().exists():
        return None
    print(f"SKIPPED: units made with PythonFMU need {python_library()} (on Debian the package libpython3.11)")
    return 1 if os.environ.get("CI") == "true" else 77


def build(folder):
    """The FMUs, by the names of their models."""
    folder.mkdir(parents=True, exist_ok=True)
    fmus = {}
    for script in sorted(MODELS.glob("*_fmi?.py")):
        tool, state = (pythonfmu3, "State") if script.stem.endswith("fmi3") else (pythonfmu, "state")
        abilities = ("canHandleVariableCommunicationStepSize", f"canGetAndSetFMU{state}", f"canSerializeFMU{state}")
        fmus[script.stem] = tool.builder.FmuBuilder.build_FMU(script, dest=folder, **dict.fromkeys(abilities, True))
    return fmus


class Checks:
    """Each method whose name begins with "check_" runs stride and returns what is wrong, as texts."""

    def __init__(self, program, units, folder):
        self.program = program
        self.folder = folder
        self.environment = {"LD_PRELOAD": str(python_library())}
        self.minimal = pathlib.Path(units) / "minimal.fmu"
        self.fmus = build(folder / "fmus")

    def run(self, name, system, *options):
        return run_system(self.program, system, self.folder / name, *options, environment=self.environment)

    def agree(self, name, system, *options):
        return [f"{name}: {text}" for text in differences(self.run(name, system, *options), Master(system).run())]

    def check_a_filter_alone(self, version):
        low_pass = self.fmus[f"low_pass_{version}"]
        start = {"filter.u": 1.5, "filter.time_constant": 0.3, "filter.y": 0.25}
        return self.agree(f"filter_{version}", System({"filter": low_pass}, start_values=start, step="0.07", stop="1"))

    def check_every_type(self, version):
        counter = self.fmus[f"counter_{version}"]
        start = {"counter.stride": 3, "counter.up": False, "counter.label": "Zähler", "counter.steps": 100}
        return self.agree(f"counter_{version}", System({"counter": counter}, start_values=start, step="0.1", stop="1"))

    def check_chains_with_our_own_unit(self, version):
        problems = []
        for other in VERSIONS:
            chain = System({"last": self.fmus[f"low_pass_{other}"], "ours": self.minimal,
                            "first": self.fmus[f"low_pass_{version}"], "count": self.fmus[f"counter_{version}"],
                            "echo": self.fmus[f"counter_{other}"]},
                           [("first.y", "ours.u"), ("ours.y", "last.u"), ("count.text", "echo.label"),
                            ("count.running", "echo.up"), ("count.steps", "echo.stride")],
                           {"first.u": 1.0, "ours.time_constant": 0.2}, step="0.05", stop="2")
            problems += self.agree(f"chain_{version}_{other}", chain)
            problems += self.agree(f"chain_{version}_{other}_in_threads", chain, "--threads=2")
        return problems

    def check_a_ring(self, version):
        low_pass = self.fmus[f"low_pass_{version}"]
        return self.agree(f"ring_{version}", System(
            {"a": low_pass, "b": low_pass}, [("a.y", "b.u"), ("b.y", "a.u")], {"a.y": 1.0}, step="0.1", stop="2"))

    def check_a_rejected_step_is_redone(self, version):
        """The filter is rolled back and steps as the counter wants, to the same values, for they do not depend on steps."""
        if version == "fmi2":
            return []  # PythonFMU has no word for it: what discards a step ends the simulation
        name = f"rejected_{version}"
        ours = self.run(name, System({"filter": self.fmus[f"low_pass_{version}"], "counter": self.fmus[f"counter_{version}"]},
                                     start_values={"filter.u": 1.0, "counter.longest_step": 0.03}, step="0.1", stop="1"))
        points = [k / 10 for k in range(11)]
        expected = {"time": points, "filter.y": [-math.expm1(-t / 0.5) for t in points], "counter.simulated": points}
        problems = differences(ours, expected, 1e-12)
        run = json.loads((self.folder / name / "run.json").read_text(encoding="utf-8"))
        rejections = {unit["name"]: unit["rejections"] for unit in run["units"]}
        if rejections["counter"] == 0 or int(ours["counter.steps"][-1]) != run["communication_steps"]:
            problems.append(f"{rejections} rejections, {ours['counter.steps'][-1]} steps of {run['communication_steps']}")
        return problems

    def check_the_library_of_python_is_found_or_asked_for(self, version):
        name = f"without_python_{version}"
        system = System({"filter": self.fmus[f"low_pass_{version}"]})
        try:
            ours = run_system(self.program, system, self.folder / name)
        except RunFailed as failure:
            return [f"{text} is not in: {failure}" for text in ("LowPass", "LD_PRELOAD=") if text not in str(failure)]
        return differences(ours, Master(system).run())

    def check_an_exception_ends_the_run(self, version):
        name = f"failure_{version}"
        try:
            self.run(name, System({"counter": self.fmus[f"counter_{version}"]}, start_values={"counter.failure": 0.5}))
        except RunFailed as failure:
            last = read_table(self.folder / name / "signals.csv")["time"][-1]
            return [text for text in ("counter", "0.4 s", "made to fail at 0.5 s") if text not in str(failure)] + (
                [f"the last row is that of {last} s"] if last != "0.4" else [])
        return ["the run ended well"]

    def check_a_unit_ends_the_run(self, version):
        system = System({"counter": self.fmus[f"counter_{version}"]}, start_values={"counter.end": 0.6})
        ours = self.run(f"end_{version}", system)
        return [] if ours["time"][-1] == "0.6" else [f"it ended at {ours['time'][-1]} s"]


def main(program, units, folder):
    if (code := skipped_without_python_library()) is not None:
        return code
    checks = Checks(program, units, pathlib.Path(folder).resolve())
    mistakes = 0
    for name in sorted(name for name in dir(Checks) if name.startswith("check_")):
        for version in VERSIONS:
            try:
                problems = getattr(checks, name)(version)
            except RunFailed as failure:
                problems = [str(failure)]
            title = name.removeprefix("check_").replace("_", " ")
            print(f"{title}, {version}: {'good' if not problems else 'FAILED'}", *problems, sep="\n  ")
            mistakes += bool(problems)
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
