"""fmpy_ssp_test.py STRIDE FOLDER: FMPy's simulation of an SSP package agrees with stride's run of the same file. The units
are those of python_units/ in FMI 2.0, the only version that FMPy couples. Results go into FOLDER."""

import pathlib
import shutil
import sys
import types
import zipfile

from fmpy.ssp.simulation import simulate_ssp

from python_units_test import build, python_library, skipped_without_python_library
from stride_run import System, differences, run_file

TOLERANCE = 1e-12  # FMPy adds up its times
STEP, STOP = 0.0625, 2.0

# FMPy has 0 at each declared input during the first step, so what is wired starts at 0, and nothing else is declared.
SYSTEM = System(
    {"first": "resources/low_pass_fmi2.fmu", "second": "resources/low_pass_fmi2.fmu",
     "count": "resources/counter_fmi2.fmu", "echo": "resources/counter_fmi2.fmu"},
    [("first.y", "second.u"), ("count.steps", "echo.stride")],
    {"first.u": 1.5, "first.time_constant": 0.25, "second.time_constant": 0.1, "count.stride": 3},
    types={"first.y": "Real", "second.u": "Real", "second.y": "Real", "count.steps": "Integer", "echo.stride": "Integer",
           "echo.steps": "Integer"})


def simulated_by_fmpy(package):
    """Its table. A row of FMPy's has the time at which a step begins, and the values at its end."""
    parameters = [types.SimpleNamespace(name=name, value=value) for name, value in SYSTEM.start_values.items()]
    result = simulate_ssp(str(package), stop_time=STOP, step_size=STEP,
                          parameter_set=types.SimpleNamespace(parameters=parameters))
    table = {"time": (result["time"] + STEP).tolist()}
    for name in ("first.y", "second.y", "count.steps", "echo.steps"):
        table[name] = result[name].tolist()
    return table


def main(program, folder):
    if (code := skipped_without_python_library()) is not None:
        return code
    folder = pathlib.Path(folder).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    fmus = build(folder / "fmus")
    ssd = folder / "SystemStructure.ssd"
    ssd.write_text(SYSTEM.ssd(portable=True), encoding="utf-8")
    (folder / "resources").mkdir()
    package = folder / "system.ssp"
    with zipfile.ZipFile(package, "w") as archive:
        archive.write(ssd, ssd.name)
        for source in sorted(set(SYSTEM.units.values())):
            shutil.copy(fmus[pathlib.Path(source).stem], folder / source)
            archive.write(folder / source, source)
    ours = run_file(program, ssd, folder / "stride", "--step", str(STEP), "--stop", str(STOP),
                    environment={"LD_PRELOAD": str(python_library())})
    expected = simulated_by_fmpy(package)
    problems = differences(ours, expected, TOLERANCE)
    print(f"{len(expected['time'])} instants: {'FMPy agrees' if not problems else 'FAILED'}", *problems, sep="\n  ")
    return 1 if problems or len(expected["time"]) != STOP / STEP else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
