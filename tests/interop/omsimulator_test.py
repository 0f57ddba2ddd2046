"""omsimulator_test.py STRIDE FOLDER: OMSimulator and stride get the same from the same SSP: from one that OMSimulator has
written, and from one of ours. Its Python package is in the folder named by the environment variable STRIDE_OMSIMULATOR.
The units are those of python_units/ in FMI 2.0. Results go into FOLDER."""

import csv
import os
import pathlib
import shutil
import subprocess
import sys
import zipfile

from python_units_test import build, python_library
from stride_run import RunFailed, System, differences, run_file

TOLERANCE = 1e-10  # OMSimulator writes twelve digits
STEP, STOP = 0.05, 1.0
COMPONENTS = {"first": "low_pass_fmi2", "second": "low_pass_fmi2", "count": "counter_fmi2", "echo": "counter_fmi2"}
START_VALUES = {"first.u": 1.5, "first.time_constant": 0.25, "second.time_constant": 0.1, "count.stride": 3}
WIRES = [("first.y", "second.u"), ("count.steps", "echo.stride"), ("count.running", "echo.up")]
RECORDED = ("first.y", "second.y", "count.steps", "count.running", "echo.steps", "echo.running", "echo.simulated")
SKIPPED = 77


def simulated_by_omsimulator(model, folder):
    """Its table: of several rows at one instant the last one, without the name of the root system."""
    results = folder / "omsimulator.csv"
    instance = model.instantiate()
    instance.setResultFile(str(results))
    instance.setStopTime(STOP)
    instance.setFixedStepSize(STEP)
    instance.initialize()
    instance.simulate()
    instance.terminate()
    instance.delete()
    with open(results, encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file, skipinitialspace=True)
    names = ["time"] + [name.partition(".")[2] for name in names[1:]]
    last = {row[0]: row for row in rows}.values()
    return {name: [read(name, row[names.index(name)]) for row in last] for name in ("time", *RECORDED)}


def read(name, text):
    if name.endswith(".running"):
        return float(text) != 0
    return int(text) if name.endswith(".steps") else float(text)


def compare(program, model, ssd, folder):
    ours = run_file(program, ssd, folder / "stride", "--step", str(STEP), "--stop", str(STOP),
                    environment={"LD_PRELOAD": str(python_library())})
    return differences(ours, simulated_by_omsimulator(model, folder), TOLERANCE)


def check_theirs(oms, program, fmus, folder):
    """What OMSimulator has written is run by stride as it is."""
    model = oms.SSP()
    for name in fmus:
        model.addResource(str(fmus[name]), new_name=f"resources/{name}.fmu")
    for component, unit in COMPONENTS.items():
        model.addComponent(oms.CRef("default", component), f"resources/{unit}.fmu")
    for source, target in WIRES:
        model.addConnection(oms.CRef("default", *source.split(".")), oms.CRef("default", *target.split(".")))
    for name, value in START_VALUES.items():
        model.setValue(oms.CRef("default", *name.split(".")), value)
    package = folder / "theirs.ssp"
    model.export(str(package))
    with zipfile.ZipFile(package) as archive:
        archive.extractall(folder / "unpacked")
    return compare(program, model, folder / "unpacked" / "SystemStructure.ssd", folder)


def check_ours(oms, program, fmus, folder):
    """Ours, with the connectors that `stride complete` writes, is read by OMSimulator."""
    resources = folder / "ours" / "resources"
    resources.mkdir(parents=True)
    for name, path in fmus.items():
        shutil.copy(path, resources / f"{name}.fmu")
    system = System({component: f"resources/{unit}.fmu" for component, unit in COMPONENTS.items()}, WIRES, START_VALUES)
    ssd = folder / "ours" / "SystemStructure.ssd"
    ssd.write_text(system.ssd(portable=True), encoding="utf-8")
    subprocess.run([program, "complete", str(ssd)], check=True, env={**os.environ, "LD_PRELOAD": str(python_library())})
    package = folder / "ours.ssp"
    with zipfile.ZipFile(package, "w") as archive:
        for path in sorted((folder / "ours").rglob("*")):
            archive.write(path, path.relative_to(folder / "ours"))
    return compare(program, oms.SSP(str(package)), ssd, folder)


def main(program, folder):
    package = os.environ.get("STRIDE_OMSIMULATOR")
    if not package:
        print("SKIPPED: STRIDE_OMSIMULATOR does not name a folder with the Python package OMSimulator. The one of PyPI fetches "
              "a program from elsewhere while it is installed, so it is not a requirement, and CI has none")
        return SKIPPED
    sys.path.insert(0, package)
    import OMSimulator as oms
    folder = pathlib.Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    fmus = {name: path for name, path in build(folder / "fmus").items() if name.endswith("fmi2")}
    oms.Settings.suppressPath = True
    mistakes = 0
    for check in (check_theirs, check_ours):
        name = check.__name__.removeprefix("check_")
        (folder / name).mkdir()
        try:
            problems = check(oms, program, fmus, folder / name)
        except RunFailed as failure:
            problems = [str(failure)]
        print(f"{name}: {'agrees' if not problems else 'FAILED'}", *problems, sep="\n  ")
        mistakes += bool(problems)
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
