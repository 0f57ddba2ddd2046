#!/usr/bin/env python3
"""Five tasks in Python with stride, and with FMPy and libcosimpy beside it: lines of code, and time.

Usage: python_tasks.py UNITS [--short]

UNITS is the folder with fmi2_complete.fmu, x' = k (u - x), which is called relaxation.fmu here: it is of FMI 2.0, since
libcosim knows no later version, and has all functions of that, as FMPy demands. The package stride is found as
PYTHONPATH and STRIDE_PREFIX say; the others are measured if this Python can import them.

Each task is a function in python_tasks/with_PACKAGE.py. Lines are those of its body without blank ones, and so without
imports. Each task is called twice in a process of its own: "first" is the time of the import and the first call, as a
script takes it, "again" that of the second call, as in a notebook. All take turns, and the medians of the rounds are
printed as multiples of stride's. A result that is not near the closed form is an error. `--short` makes one round, and
tests that all of this works.
"""

import argparse
import ast
import importlib.util
import json
import math
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

FOLDER = Path(__file__).resolve().parent / "python_tasks"
PACKAGES = {"stride": "stride", "FMPy": "fmpy", "libcosimpy": "libcosimpy"}  # by what is imported
TASKS = {
    "simulate": "simulate an FMU, arrays to plot",
    "change": "a parameter, and an input over time",
    "feedback": "step by step, with feedback from Python",
    "couple": "couple two FMUs",
    "vary": "100 runs with other parameters, a table",
}
ROUNDS = 7


def lines_of(package, task):
    source = (FOLDER / f"with_{package}.py").read_text(encoding="utf-8")
    function = next(each for each in ast.parse(source).body if isinstance(each, ast.FunctionDef) and each.name == task)
    body = source.splitlines()[function.lineno : function.end_lineno]
    return sum(1 for line in body if line.strip())


# ---- In a process of its own: python_tasks.py --call PACKAGE TASK FMU prints seconds and the result ----


def call(package, task, fmu):
    sys.path.insert(0, str(FOLDER))
    began = time.perf_counter()
    function = getattr(importlib.import_module(f"with_{package}"), task)
    first_result = function(fmu)
    first = time.perf_counter() - began
    began = time.perf_counter()
    function(fmu)
    again = time.perf_counter() - began
    abscissas, values = (list(map(float, each)) for each in first_result)
    print(json.dumps({"first": first, "again": again, "abscissas": abscissas, "values": values}))


def measure(package, task, fmu):
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([sys.executable, __file__, "--call", package, task, str(fmu)], cwd=folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if done.returncode != 0:
        sys.exit(f"{package}, {task}: exit code {done.returncode}\n{done.stderr}")
    return json.loads(done.stdout.splitlines()[-1])


# ---- Whether a result is right ----


def expected(task):
    """The value for an abscissa, and how far a result may be from it; None: it has no closed form."""
    if task == "simulate":
        return (lambda t: math.exp(-2 * t)), 1e-9
    if task == "change":  # x' = (sin t - x) / 2, with inputs that are held for 10 ms
        return (lambda t: 1.4 * math.exp(-t / 2) + 0.2 * math.sin(t) - 0.4 * math.cos(t)), 5e-3
    if task == "couple":  # b is two steps late at most
        return (lambda t: (1 + 2 * t) * math.exp(-2 * t)), 3e-2
    if task == "vary":
        return (lambda k: math.exp(-k)), 1e-9
    return None


def check(package, task, result):
    """Raises SystemExit for a wrong result. Returns the largest error, or None."""
    abscissas, values = result["abscissas"], result["values"]
    if len(abscissas) != len(values) or len(values) < (100 if task == "vary" else 1000):
        sys.exit(f"{package}, {task}: {len(abscissas)} and {len(values)} values")
    if task == "feedback":  # it switches around 0.5
        late = values[500:]
        if not all(0.47 < value < 0.53 for value in late):
            sys.exit(f"{package}, {task}: {min(late)} to {max(late)}, expected values around 0.5")
        return None
    function, tolerance = expected(task)
    error = max(abs(value - function(at)) for at, value in zip(abscissas, values))
    if error > tolerance:
        sys.exit(f"{package}, {task}: an error of {error}, expected {tolerance} at most")
    return error


def number(value):
    return f"{value:.0f}" if value >= 10 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"


def main():
    if sys.argv[1:2] == ["--call"]:
        return call(*sys.argv[2:])
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("units", type=Path)
    arguments.add_argument("--short", action="store_true")
    request = arguments.parse_args()
    present = {name: module for name, module in PACKAGES.items() if importlib.util.find_spec(module)}
    for name in PACKAGES.keys() - present.keys():
        print(f"skipped: {name}, since this Python has no {PACKAGES[name]}")
    if "stride" not in present:
        sys.exit("the package stride cannot be imported: set PYTHONPATH and STRIDE_PREFIX")
    folder = tempfile.TemporaryDirectory()
    fmu = shutil.copy(request.units / "fmi2_complete.fmu", Path(folder.name, "relaxation.fmu"))
    times = {(module, task): {"first": [], "again": []} for task in TASKS for module in present.values()}
    errors = {}
    for _ in range(1 if request.short else ROUNDS):
        for (module, task), seconds in times.items():
            result = measure(module, task, fmu)
            errors[module, task] = check(module, task, result)
            for which, list_ in seconds.items():
                list_.append(result[which])

    others = [name for name in present if name != "stride"]
    columns = [f"lines, {name}" for name in present]
    columns += [f"{which}, {name}" for which in ("first", "again") for name in others]
    print("| " + " | ".join(["task", *columns]) + " |\n" + "|---" * (1 + len(columns)) + "|")
    for task, title in TASKS.items():
        cells = [title, *(str(lines_of(module, task)) for module in present.values())]
        for which in ("first", "again"):
            own = statistics.median(times["stride", task][which])
            cells += [number(statistics.median(times[present[name], task][which]) / own) for name in others]
        print("| " + " | ".join(cells) + " |")
    for (module, task), error in errors.items():
        if error is not None:
            print(f"largest error, {module}, {task}: {error:.1e}")


if __name__ == "__main__":
    main()
