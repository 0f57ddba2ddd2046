"""fmpy_test.py [--validate-only=NAME,…] FMU…: FMPy finds nothing wrong with the units' descriptions, drives them with and
without Event Mode and early returns, saves and restores them. Each unit is tried in a child process, so that it cannot
harm the others; those named after --validate-only are looked at, but not simulated."""

import contextlib
import io
import math
import multiprocessing
import pathlib
import shutil
import sys

import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException
from fmpy.simulation import instantiate_fmu
from fmpy.validation import validate_fmu

STEP, STEPS = 1e-3, 50
STOP = STEP * STEPS
FLOATS = {"Float32": np.float32, "Float64": np.float64}
TYPES = {**FLOATS, "Int8": np.int8, "UInt8": np.uint8, "Int16": np.int16, "UInt16": np.uint16, "Int32": np.int32,
         "UInt32": np.uint32, "Int64": np.int64, "UInt64": np.uint64, "Boolean": np.bool_, "Enumeration": np.int64}
RAMPS = {0.0: 0.0, 0.0125: 1.0, 0.0205: 0.36, 0.025: 0.0, 0.035: -0.8, 0.0375: -1.0, STOP: 0.0}  # time: -1 to 1
JUMPS = (0.0205, 0.035)  # one of them between two communication points
START_VALUES = {"stepper": {"early_at": 0.0105}}  # it stops between two communication points, for an event


def outputs(description):
    """The outputs that FMPy can record: not clocked, no clocks, no binaries."""
    skipped = ("Clock", "Binary", "String")
    return [v.name for v in description.modelVariables
            if v.causality == "output" and v.type not in skipped and not v.clocks]


def driven_inputs(description):
    return [v for v in description.modelVariables
            if v.causality == "input" and v.type in TYPES and not v.clocks and not v.shape]


def within(value, variable):
    least = float(variable.min) if variable.min is not None else -math.inf
    most = float(variable.max) if variable.max is not None else math.inf
    return min(max(value, least), most)


def value_at(variable, time, ramp):
    """A continuous input follows the ramps around its start value; all others jump there and back."""
    if variable.type == "Boolean":
        start = str(variable.start).lower() in ("1", "true")
    else:
        start = float(variable.start) if variable.type in FLOATS else int(variable.start)
    if variable.variability == "continuous":
        return within(start + ramp * (0.1 * abs(start) + 0.01), variable)
    elsewhere = JUMPS[0] <= time < JUMPS[1]
    if not elsewhere:
        return start
    if variable.type == "Boolean":
        return not start
    if variable.type == "Enumeration":
        others = [int(item.value) for item in variable.declaredType.items if int(item.value) != start]
        return others[0] if others else start
    up = within(start + 1, variable)
    return up if up != start else within(start - 1, variable)


def signals(description):
    """What FMPy drives the inputs with; None if there are none."""
    inputs = driven_inputs(description)
    if not inputs:
        return None
    rows = [(time, *(value_at(v, time, ramp) for v in inputs)) for time, ramp in RAMPS.items()]
    return np.array(rows, dtype=[("time", np.float64), *((v.name, TYPES[v.type]) for v in inputs)])


class Log:
    """What a unit says, by its status."""

    def __init__(self):
        self.messages = []

    def __call__(self, _environment, status, _category, message):
        self.messages.append((status, message.decode("utf-8")))

    def problems(self, clocks_missed):
        """Errors are none; an importer without Event Mode is told once each what it misses of the clocks."""
        found = [f"it says '{text}'" for status, text in self.messages if status > 1]
        for kind in ("input", "output"):
            said = sum(f"{kind} clocks" in text for _, text in self.messages)
            if said != 1 and kind in clocks_missed or said > 1:
                found.append(f"what happens to its {kind} clocks is said {said} times")
        return found


def clock_kinds(description):
    return {v.causality for v in description.modelVariables if v.type == "Clock"}


def simulate(path, event_mode, early_return):
    """FMPy's result with all inputs driven, and what is wrong with it."""
    description = read_model_description(path)
    log = Log()
    with contextlib.redirect_stdout(io.StringIO()):  # FMPy names each input that is not driven
        result = simulate_fmu(path, start_time=0.0, stop_time=STOP, output_interval=STEP, output=outputs(description),
                              input=signals(description), fmi_type="CoSimulation", use_event_mode=event_mode,
                              early_return_allowed=early_return, logger=log,
                              start_values=START_VALUES.get(description.modelName, {}))
    missed = set() if event_mode else clock_kinds(description) & {"input"}
    problems = log.problems(missed)
    end = result["time"][-1]
    if not math.isclose(end, STOP, abs_tol=1e-9):
        problems.append(f"the simulation ended at {end} s instead of {STOP} s")
    for name in result.dtype.names[1:]:
        column = result[name]
        if np.issubdtype(column.dtype, np.floating) and not np.all(np.isfinite(column)):
            problems.append(f"{name} is not finite")
    how = f"{'with' if event_mode else 'without'} Event Mode, {'with' if early_return else 'without'} early return"
    return result, [f"{how}: {problem}" for problem in problems]


def on_grid(result):
    """The last row at each communication point that FMPy makes of its own."""
    rows = {round(time / STEP): row for row, time in enumerate(result["time"]) if abs(time / STEP - round(time / STEP)) < 1e-6}
    return result[list(rows.values())]


def compare(one, other):
    """Without Event Mode a unit handles its events at their instants, so early returns change nothing."""
    one, other = on_grid(one), on_grid(other)
    if len(one) != STEPS + 1 or len(other) != STEPS + 1:
        return [f"{len(one)} and {len(other)} rows on the grid instead of {STEPS + 1}"]
    return [f"without Event Mode, {name} depends on whether early returns are allowed" for name in one.dtype.names[1:]
            if not np.allclose(one[name].astype(float), other[name].astype(float), rtol=1e-9, atol=1e-12)]


class Instance:
    """The unit stepped by hand, through FMPy's FMU3Slave."""

    def __init__(self, folder, description, event_mode):
        self.description = description
        self.event_mode = event_mode
        self.log = Log()
        self.fmu = instantiate_fmu(folder, description, "CoSimulation", event_mode_used=event_mode, logger=self.log)
        self.variables = {v.name: v for v in description.modelVariables}
        self.signals = signals(description)

    def start(self):
        self.fmu.enterInitializationMode(startTime=0.0, stopTime=STOP)
        self.fmu.exitInitializationMode()
        if self.event_mode:
            self.settle()

    def settle(self):
        while self.fmu.updateDiscreteStates()[0]:
            pass
        self.fmu.enterStepMode()

    def drive(self, time):
        row = self.signals[np.searchsorted(self.signals["time"], time, side="right") - 1]
        for name in self.signals.dtype.names[1:]:
            variable = self.variables[name]
            kind = "Int64" if variable.type == "Enumeration" else variable.type
            getattr(self.fmu, f"set{kind}")([variable.valueReference], [row[name].item()])

    def step(self, k):
        """Step k; returns all that can be seen of the unit behind it."""
        if self.signals is not None:
            if self.event_mode:
                self.fmu.enterEventMode()
            self.drive(k * STEP)
            if self.event_mode:
                self.settle()
        event, *_ = self.fmu.doStep(k * STEP, (k + 1) * STEP - k * STEP)
        if event:
            self.fmu.enterEventMode()
            self.settle()
        return [self.value(v) for v in self.description.modelVariables if v.type != "Clock"]

    def value(self, variable):
        kind = "Int64" if variable.type == "Enumeration" else variable.type
        size = int(np.prod(variable.shape)) if variable.shape else 1
        return variable.name, np.array(getattr(self.fmu, f"get{kind}")([variable.valueReference], nValues=size)).tobytes()

    def free(self):
        self.fmu.freeInstance()


def check_state(folder, description, event_mode):
    """A restored unit, and a new one with the state as bytes, go on with the bits of the one that was saved."""
    unit = Instance(folder, description, event_mode)
    unit.start()
    half = STEPS // 2
    for k in range(half):
        unit.step(k)
    if not description.coSimulation.canGetAndSetFMUstate:
        try:
            unit.fmu.getFMUState()
        except FMICallException:
            said = any("cannot save its state" in text for _, text in unit.log.messages)
            return [] if said else ["it does not say why it cannot be saved"]
        finally:
            unit.free()
        return ["it can be saved, against its description"]
    state = unit.fmu.getFMUState()
    data = unit.fmu.serializeFMUState(state)
    after = [unit.step(k) for k in range(half, STEPS)]
    unit.fmu.setFMUState(state)
    again = [unit.step(k) for k in range(half, STEPS)]
    unit.fmu.freeFMUState(state)
    unit.free()

    fresh = Instance(folder, description, event_mode)
    fresh_state = fresh.fmu.deserializeFMUState(data)
    fresh.fmu.setFMUState(fresh_state)
    from_bytes = [fresh.step(k) for k in range(half, STEPS)]
    fresh.fmu.freeFMUState(fresh_state)
    fresh.free()
    problems = [f"{kind} it goes on otherwise in '{first_difference(after, other)}'"
                for kind, other in (("restored", again), ("from bytes", from_bytes)) if other != after]
    return problems + unit.log.problems(set()) + fresh.log.problems(set())


def first_difference(one, other):
    return next(a[0] for row, again in zip(one, other) for a, b in zip(row, again) if a != b)


def check(path, validate_only):
    """What is wrong with a unit."""
    problems = [f"validation: {problem}" for problem in validate_fmu(path)]
    if validate_only:
        return problems
    description = read_model_description(path)
    results = {}
    for event_mode in (False, True):
        for early_return in (False, True):
            results[event_mode, early_return], found = simulate(path, event_mode, early_return)
            problems += found
    problems += compare(results[False, False], results[False, True])
    folder = extract(path)
    for event_mode in (False, True):
        mode = "with" if event_mode else "without"
        problems += [f"saved {mode} Event Mode: {text}" for text in check_state(folder, description, event_mode)]
    shutil.rmtree(folder, ignore_errors=True)
    return problems


def child(path, validate_only):
    try:
        problems = check(path, validate_only)
    except Exception as failure:  # FMPy raises many kinds
        problems = [f"{type(failure).__name__}: {failure}"]
    for problem in problems:
        print(f"  {problem}", flush=True)
    sys.exit(1 if problems else 0)


def main(arguments):
    validate_only = set()
    if arguments and arguments[0].startswith("--validate-only="):
        validate_only = set(arguments.pop(0).partition("=")[2].split(","))
    processes = multiprocessing.get_context("fork")
    mistakes = 0
    for path in arguments:
        process = processes.Process(target=child, args=(path, pathlib.Path(path).stem in validate_only))
        process.start()
        process.join()
        mistakes += process.exitcode != 0
        print(f"{path}: {'good' if process.exitcode == 0 else f'FAILED, exit code {process.exitcode}'}", flush=True)
    print(f"{len(arguments)} units, {mistakes} of them wrong")
    return 1 if mistakes or not arguments else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
