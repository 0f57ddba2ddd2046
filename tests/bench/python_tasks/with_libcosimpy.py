"""The tasks of python_tasks.py as users of libcosimpy write them. Its times are nanoseconds."""

import csv
import math

from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave


def simulate(fmu):
    execution = CosimExecution.from_step_size(10_000_000)
    unit = execution.add_local_slave(CosimLocalSlave(fmu, "unit"))
    references = {v.name.decode(): v.reference for v in execution.slave_variables(unit)}
    observer = CosimObserver.create_time_series(1001)
    execution.add_observer(observer)
    observer.start_time_series(unit, references["x"], CosimVariableType.REAL)
    execution.simulate_until(10_000_000_000)
    time, _, x = observer.time_series_real_samples(unit, references["x"], 1, 1000)
    return [each / 1e9 for each in time], x


def change(fmu):
    execution = CosimExecution.from_step_size(10_000_000)
    unit = execution.add_local_slave(CosimLocalSlave(fmu, "unit"))
    references = {v.name.decode(): v.reference for v in execution.slave_variables(unit)}
    execution.real_initial_value(unit, references["k"], 0.5)
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    time, x = [0.0], [1.0]
    for i in range(1000):
        manipulator.slave_real_values(unit, [references["u"]], [math.sin(i * 0.01)])
        execution.step()
        time.append((i + 1) * 0.01)
        x += observer.last_real_values(unit, [references["x"]])
    return time, x


def feedback(fmu):
    execution = CosimExecution.from_step_size(10_000_000)
    unit = execution.add_local_slave(CosimLocalSlave(fmu, "unit"))
    references = {v.name.decode(): v.reference for v in execution.slave_variables(unit)}
    observer, manipulator = CosimObserver.create_last_value(), CosimManipulator.create_override()
    execution.add_observer(observer)
    execution.add_manipulator(manipulator)
    time, x = [0.0], [1.0]
    for i in range(1000):
        manipulator.slave_real_values(unit, [references["u"]], [1.0 if x[-1] < 0.5 else 0.0])
        execution.step()
        time.append((i + 1) * 0.01)
        x += observer.last_real_values(unit, [references["x"]])
    return time, x


def couple(fmu):
    execution = CosimExecution.from_step_size(10_000_000)
    a, b = [execution.add_local_slave(CosimLocalSlave(fmu, name)) for name in ("a", "b")]
    references = {v.name.decode(): v.reference for v in execution.slave_variables(a)}
    execution.connect_real_variables(a, references["x"], b, references["u"])
    observer = CosimObserver.create_time_series(1001)
    execution.add_observer(observer)
    observer.start_time_series(b, references["x"], CosimVariableType.REAL)
    execution.simulate_until(10_000_000_000)
    time, _, x = observer.time_series_real_samples(b, references["x"], 1, 1000)
    return [each / 1e9 for each in time], x


def vary(fmu):
    rows = []
    for i in range(100):
        k = 0.1 + 0.05 * i
        execution = CosimExecution.from_step_size(10_000_000)
        unit = execution.add_local_slave(CosimLocalSlave(fmu, "unit"))
        references = {v.name.decode(): v.reference for v in execution.slave_variables(unit)}
        execution.real_initial_value(unit, references["k"], k)
        observer = CosimObserver.create_last_value()
        execution.add_observer(observer)
        execution.simulate_until(1_000_000_000)
        rows.append((k, observer.last_real_values(unit, [references["x"]])[0]))
    with open("table.csv", "w", newline="") as file:
        csv.writer(file).writerows([("k", "x"), *rows])
    return zip(*rows)
