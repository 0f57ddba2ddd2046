"""reference_fmus_test.py STRIDE FOLDER: the FMUs in the folder named by the environment variable STRIDE_REFERENCE_FMUS, such
as the Modelica Association's Reference FMUs, run in stride one by one and in systems. Results go into FOLDER.

One by one each is compared with FMPy's simulation of it, and with the results that it carries along
(extra/org.fmi-standard.fmi-ls-ref); systems of those that are there are compared bit by bit with reference_master.py."""

import csv
import io
import os
import pathlib
import sys
import zipfile
from fractions import Fraction

from fmpy import read_model_description, simulate_fmu

from reference_master import Master
from stride_run import RunFailed, System, differences, run_system

MOST_STEPS = 2000
TOLERANCE = 1e-9  # FMPy's communication points are rounded otherwise than stride's
SKIPPED = 77


def step_of(description):
    """The communication step that the FMU asks for, as a decimal."""
    experiment = description.defaultExperiment
    size = (experiment and experiment.stepSize) or description.coSimulation.fixedInternalStepSize or "0.01"
    return str(size)


def stop_of(description):
    """Where its own experiment ends, but not after more than MOST_STEPS, as a decimal."""
    experiment = description.defaultExperiment
    stop = Fraction((experiment and experiment.stopTime) or "1")
    return str(float(min(stop, MOST_STEPS * Fraction(step_of(description)))))


def up_to(end, table):
    """Without the rows behind the end; FMPy goes on when a unit asks for the end in an event."""
    rows = [row for row, time in enumerate(table["time"]) if time < end + TOLERANCE]
    return {name: [column[row] for row in rows] for name, column in table.items()}


def simulated_by_fmpy(path, description, step):
    """FMPy's table; of several rows at one instant the last one, behind the events."""
    event_mode = bool(getattr(description.coSimulation, "hasEventMode", False))
    result = simulate_fmu(str(path), stop_time=float(stop_of(description)), output_interval=float(step),
                          fmi_type="CoSimulation", use_event_mode=event_mode,
                          model_description=description)
    times = result["time"]
    last = [i for i, time in enumerate(times) if i + 1 == len(times) or times[i + 1] > time]
    table = {"time": [float(times[i]) for i in last]}
    for name in [v.name for v in description.modelVariables if v.name in result.dtype.names[1:] and v.alias is None]:
        values = result[name][last]
        if values.ndim == 1:
            table[f"unit.{name}"] = values.tolist()
        else:
            for column in range(values.shape[1]):
                table[f"unit.{name}[{column + 1}]"] = values[:, column].tolist()
    return table


def value_of(text, variable):
    if variable.type == "Boolean":
        return text in ("1", "true")
    if variable.type == "Binary":
        return bytes.fromhex(text)
    if variable.type in ("Float32", "Float64", "Real"):
        return float(text)
    return text if variable.type == "String" else int(text)


def carried_along(path, description):
    """The results inside the FMU, or nothing."""
    variables = {variable.name: variable for variable in description.modelVariables}
    with zipfile.ZipFile(path) as archive:
        names = [name for name in archive.namelist() if name.endswith("_out.csv")]
        if not names:
            return None
        header, *rows = csv.reader(io.StringIO(archive.read(names[0]).decode("utf-8")))
    table = {"time": [float(row[0]) for row in rows]}
    for column, name in enumerate(header[1:], 1):
        if name not in variables:
            continue  # the file is the same for all versions of FMI
        variable = variables[name]
        for row in rows:
            elements = row[column].split() if variable.shape else [row[column]]
            for index, element in enumerate(elements):
                suffix = f"[{index + 1}]" if variable.shape else ""
                table.setdefault(f"unit.{name}{suffix}", []).append(value_of(element, variable))
    return table


class NothingToCompare(Exception):
    """Why a unit is left out."""


def check_one(program, path, folder):
    """What is wrong with the FMU alone. Raises NothingToCompare."""
    description = read_model_description(str(path), validate=False)
    if description.coSimulation is None:
        raise NothingToCompare("not for co-simulation")
    system = System({"unit": path}, step=step_of(description), stop=stop_of(description))
    try:
        by_fmpy = simulated_by_fmpy(path, description, system.step)
    except Exception as failure:  # FMPy raises many kinds
        raise NothingToCompare(f"FMPy cannot run it: {failure}") from failure
    ours = run_system(program, system, folder)
    end = float(ours["time"][-1])
    problems = [f"FMPy: {text}" for text in differences(ours, up_to(end, by_fmpy), TOLERANCE)]
    reference = carried_along(path, description)
    if reference is not None:
        problems += [f"its own results: {text}" for text in differences(ours, up_to(end, reference), TOLERANCE)]
    return problems


def systems(fmus):
    """Systems of the Reference FMUs, in every mixture of the two versions of FMI that is there."""
    versions = sorted({version for version, _ in fmus})
    for source in versions:
        for target in versions:
            stair, oscillator, sink = fmus.get((source, "Stair")), fmus.get((source, "VanDerPol")), fmus.get((target, "Feedthrough"))
            if stair and sink:
                yield f"stair_{source}_to_{target}", System(
                    {"stair": stair, "sink": sink}, [("stair.counter", "sink.Int32_input")], step="0.2", stop="12")
            if oscillator and sink:
                yield f"oscillator_{source}_to_{target}", System(
                    {"sink": sink, "oscillator": oscillator},
                    [("oscillator.x0", "sink.Float64_continuous_input"), ("oscillator.x1", "sink.Float64_discrete_input")],
                    {"oscillator.mu": 0.75}, step="0.1", stop="5")
    space = fmus.get(("3.0", "StateSpace"))
    if space:
        yield "state_spaces", System(
            {"first": space, "second": space}, [("first.y", "second.u")],
            {"first.A": [-1.0, 0.5, 0.0, 0.0, -0.5, 0.25, 0.0, 0.0, -0.25], "first.u": [0.5, -1.0, 2.0]}, step="1", stop="10")


def check_all(program, folder, fmus):
    """Runs everything and prints what it finds. Returns the number of runs and of those that are wrong."""
    runs, mistakes = 0, 0

    def judge(name, check):
        nonlocal runs, mistakes
        try:
            problems = check()
        except NothingToCompare as reason:
            print(f"{name}: left out, {reason}")
            return
        except RunFailed as failure:
            problems = [str(failure)]
        runs += 1
        mistakes += bool(problems)
        print(f"{name}: {'agrees' if not problems else 'FAILED'}", *problems, sep="\n  ")

    for (version, name), path in sorted(fmus.items()):
        judge(f"{name}, FMI {version}", lambda path=path, where=folder / f"{name}_{version}": check_one(program, path, where))
    for name, system in systems(fmus):
        judge(name, lambda system=system, where=folder / name:
              differences(run_system(program, system, where), Master(system).run()))
    return runs, mistakes


def main(program, folder):
    source = os.environ.get("STRIDE_REFERENCE_FMUS")
    if not source:
        print("SKIPPED: STRIDE_REFERENCE_FMUS does not name a folder with FMUs of other tools. They are not part of stride, so "
              "CI has none either; the Reference FMUs are at https://github.com/modelica/Reference-FMUs")
        return SKIPPED
    fmus = {}
    for path in sorted(pathlib.Path(source).rglob("*.fmu")):
        description = read_model_description(str(path), validate=False)
        fmus[description.fmiVersion[:3], path.stem] = path
    runs, mistakes = check_all(program, pathlib.Path(folder), fmus)
    print(f"{runs} runs, {mistakes} of them wrong")
    return 1 if mistakes or not runs else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
