"""The tasks of python_tasks.py as users of FMPy write them."""

import csv

import numpy as np
from fmpy import extract, instantiate_fmu, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave


def simulate(fmu):
    result = simulate_fmu(fmu, stop_time=10, output_interval=0.01)
    return result["time"], result["x"]


def change(fmu):
    instants = np.arange(0, 10.005, 0.01)
    signal = np.array(list(zip(instants, np.sin(instants))), dtype=[("time", float), ("u", float)])
    result = simulate_fmu(fmu, stop_time=10, output_interval=0.01, start_values={"k": 0.5}, input=signal)
    return result["time"], result["x"]


def feedback(fmu):
    description = read_model_description(fmu)
    references = {v.name: v.valueReference for v in description.modelVariables}
    unit = FMU2Slave(guid=description.guid, unzipDirectory=extract(fmu), instanceName="unit",
                     modelIdentifier=description.coSimulation.modelIdentifier)
    unit.instantiate()
    unit.setupExperiment(startTime=0, stopTime=10)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    time, x = [0.0], [1.0]
    for i in range(1000):
        unit.setReal([references["u"]], [1.0 if x[-1] < 0.5 else 0.0])
        unit.doStep(i * 0.01, 0.01)
        time.append((i + 1) * 0.01)
        x += unit.getReal([references["x"]])
    unit.terminate()
    unit.freeInstance()
    return time, x


def couple(fmu):
    description = read_model_description(fmu)
    references = {v.name: v.valueReference for v in description.modelVariables}
    folder = extract(fmu)
    a, b = [FMU2Slave(guid=description.guid, unzipDirectory=folder, instanceName=name,
                      modelIdentifier=description.coSimulation.modelIdentifier) for name in ("a", "b")]
    for unit in (a, b):
        unit.instantiate()
        unit.setupExperiment(startTime=0, stopTime=10)
        unit.enterInitializationMode()
    b.setReal([references["u"]], a.getReal([references["x"]]))
    for unit in (a, b):
        unit.exitInitializationMode()
    time, x = [0.0], b.getReal([references["x"]])
    for i in range(1000):
        a.doStep(i * 0.01, 0.01)
        b.doStep(i * 0.01, 0.01)
        time.append((i + 1) * 0.01)
        x += b.getReal([references["x"]])
        b.setReal([references["u"]], a.getReal([references["x"]]))
    for unit in (a, b):
        unit.terminate()
        unit.freeInstance()
    return time, x


def vary(fmu):
    description = read_model_description(fmu)
    folder = extract(fmu)
    unit = instantiate_fmu(folder, description)
    rows = []
    for i in range(100):
        k = 0.1 + 0.05 * i
        unit.reset()
        result = simulate_fmu(folder, stop_time=1, output_interval=0.01, start_values={"k": k},
                              model_description=description, fmu_instance=unit)
        rows.append((k, result["x"][-1]))
    unit.freeInstance()
    with open("table.csv", "w", newline="") as file:
        csv.writer(file).writerows([("k", "x"), *rows])
    return zip(*rows)
