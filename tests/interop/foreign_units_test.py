"""foreign_units_test.py STRIDE FOLDER: the FMUs and system files in the folder named by the environment variable
STRIDE_FOREIGN_UNITS, such as those that other projects keep for their tests, run in stride: each distinct FMU that FMPy can
simulate for a second, and each system of such FMUs, and agree with reference_master.py. Results go into FOLDER."""

import hashlib
import multiprocessing
import os
import pathlib
import shutil
import sys

from fmpy import read_model_description

from reference_master import Master
from reference_ssp import NothingToCompare, read_system
from stride_run import RunFailed, System, differences, run_file, run_system

STEP, STOP = "0.01", "1"
TOLERANCE = 1e-6
PATIENCE = 120  # seconds for FMPy's simulation
SKIPPED = 77
NOT_COMPARED = {
    "acvs_compositeModel/SystemStructure.ssd": "it begins with an algebraic loop, and some of its units keep what they were "
                                               "set to on the way to the solution",
}


def simulate(system, answers):
    try:
        answers.put(Master(system).run())
    except Exception as failure:  # FMPy raises many kinds
        answers.put(f"{type(failure).__name__}: {failure}")


def simulated_by_fmpy(system):
    """The table, made in a process of its own, which a unit may take down. Raises NothingToCompare."""
    answers = multiprocessing.Queue()
    process = multiprocessing.Process(target=simulate, args=(system, answers))
    process.start()
    try:
        answer = answers.get(timeout=PATIENCE)
    except Exception as nothing:
        raise NothingToCompare("FMPy crashes, or takes too long") from nothing
    finally:
        process.kill()
        process.join()
    if isinstance(answer, str):
        raise NothingToCompare(f"FMPy cannot run it: {answer}")
    return answer


def check_unit(program, path, folder):
    description = read_model_description(str(path), validate=False)
    if description.coSimulation is None:
        raise NothingToCompare("not for co-simulation")
    if any(variable.type == "Clock" for variable in description.modelVariables):
        raise NothingToCompare("it has clocks, which the reference does not tick")
    system = System({"unit": path}, step=STEP, stop=STOP)
    expected = simulated_by_fmpy(system)
    return differences(run_system(program, system, folder), expected, TOLERANCE)


def check_system(program, path, folder):
    for end, reason in NOT_COMPARED.items():
        if path.as_posix().endswith(end):
            raise NothingToCompare(reason)
    file = path
    if path.suffix == ".ssp":
        shutil.unpack_archive(path, folder / "package", "zip")
        file = folder / "package" / "SystemStructure.ssd"
    system, names = read_system(file, STEP, STOP)
    table = simulated_by_fmpy(system)
    expected = {"time": table.pop("time")}
    for name, column in table.items():
        unit, _, variable = name.partition(".")
        expected[f"{names[unit]}.{variable}"] = column
    ours = run_file(program, path, folder / "results", "--step", system.step, "--stop", STOP)
    return differences(ours, expected, TOLERANCE)


def distinct(paths):
    """The first of those that are the same, byte for byte."""
    by_content = {}
    for path in sorted(paths):
        by_content.setdefault(hashlib.sha256(path.read_bytes()).hexdigest(), path)
    return by_content.values()


def main(program, folder):
    source = os.environ.get("STRIDE_FOREIGN_UNITS")
    if not source:
        print("SKIPPED: STRIDE_FOREIGN_UNITS does not name a folder with FMUs and system files of other tools. They are not "
              "part of stride, so CI has none either; projects that keep some for their tests are "
              "open-simulation-platform/libcosim, OpenModelica/OMSimulator and INTO-CPS-Association/maestro on GitHub")
        return SKIPPED
    source, folder = pathlib.Path(source).resolve(), pathlib.Path(folder)
    tasks = [(check_unit, path) for path in distinct(source.rglob("*.fmu"))]
    tasks += [(check_system, path) for path in sorted([*source.rglob("*.ssd"), *source.rglob("*.ssp")])]
    runs, mistakes = 0, 0
    for number, (check, path) in enumerate(tasks):
        name = path.relative_to(source)
        try:
            problems = check(program, path, folder / f"{number}_{path.stem}")
        except NothingToCompare as reason:
            print(f"{name}: left out, {reason}", flush=True)
            continue
        except RunFailed as failure:
            problems = [str(failure)]
        runs += 1
        mistakes += bool(problems)
        print(f"{name}: {'agrees' if not problems else 'FAILED'}", *problems[:3], sep="\n  ", flush=True)
    print(f"{runs} runs, {mistakes} of them wrong")
    return 1 if mistakes or not runs else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
