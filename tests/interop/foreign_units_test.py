"""foreign_units_test.py STRIDE FOLDER: the FMUs and system files in the folder named by the environment variable
STRIDE_FOREIGN_UNITS, such as those that other projects keep for their tests, run in stride: each distinct FMU that FMPy can
simulate for a second, and each flat system of such FMUs, and agree with reference_master.py. Results go into FOLDER."""

import hashlib
import multiprocessing
import os
import pathlib
import sys
from xml.etree import ElementTree

from fmpy import read_model_description

from reference_master import Master
from stride_run import RunFailed, System, differences, run_file, run_system

STEP, STOP = "0.01", "1"
TOLERANCE = 1e-6
PATIENCE = 120  # seconds for FMPy's simulation
SKIPPED = 77
SSD = "{http://ssp-standard.org/SSP1/SystemStructureDescription}"
SSC = "{http://ssp-standard.org/SSP1/SystemStructureCommon}"
SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"


class NothingToCompare(Exception):
    """Why a unit or a system is left out."""


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


def value_of(parameter):
    kind = parameter[0].tag.removeprefix(SSV)
    text = parameter[0].get("value")
    return {"Real": float, "Integer": int, "Boolean": lambda word: word in ("true", "1")}.get(kind, str)(text)


def read_system(path):
    """The file as a System, if it is flat and has nothing but FMUs, wires and values in it. Raises NothingToCompare."""
    root = ElementTree.parse(path).getroot()
    inner = root.find(f"{SSD}System")
    experiment = root.find(f"{SSD}DefaultExperiment")
    if experiment is not None and float(experiment.get("startTime", "0")) != 0:
        raise NothingToCompare("it does not start at 0 s")
    if inner is None or root.findall(f".//{SSD}ParameterBinding[@source]") or inner.find(f"{SSD}Elements/{SSD}System") is not None:
        raise NothingToCompare("it is not flat, or has values in other files")
    if any(len(wire) for wire in inner.iter(f"{SSD}Connection")):
        raise NothingToCompare("it has transformations")
    units, values = {}, {}
    for component in inner.iter(f"{SSD}Component"):
        units[component.get("name")] = path.parent / component.get("source")
        for parameter in component.iter(f"{SSV}Parameter"):
            values[f"{component.get('name')}.{parameter.get('name')}"] = value_of(parameter)
    if not units or not all(file.is_file() for file in units.values()):
        raise NothingToCompare("it has no FMUs, or not all of them are there")
    wires = [(f"{wire.get('startElement')}.{wire.get('startConnector')}", f"{wire.get('endElement')}.{wire.get('endConnector')}")
             for wire in inner.iter(f"{SSD}Connection") if wire.get("startElement") and wire.get("endElement")]
    steps = [element.get("baseStepSize") or element.get("stepSize") for element in root.iter()
             if element.tag.endswith(("}FixedStepAlgorithm", "}FixedStepMaster"))]
    return System(units, wires, values, step=steps[0] if steps else STEP, stop=STOP)


def check_system(program, path, folder):
    system = read_system(path)
    expected = simulated_by_fmpy(system)
    ours = run_file(program, path, folder, "--step", system.step, "--stop", STOP)
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
    tasks += [(check_system, path) for path in distinct(source.rglob("*.ssd"))]
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
