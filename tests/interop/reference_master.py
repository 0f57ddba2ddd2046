"""The simplest co-simulation master there can be, on top of FMPy: fixed steps, inputs held (Jacobi), FMI 2.0 and 3.0.
It shares no line with stride, and both must get the same bits from the same units. Events are handled at communication
points only, and the system must have no algebraic loop."""

import itertools
import shutil

from fmpy import extract, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Discard, fmi2LastSuccessfulTime, fmi2Terminated
from fmpy.simulation import instantiate_fmu


class Unit:
    """An instance of an FMU, with variables by their names."""

    def __init__(self, path):
        self.description = read_model_description(path, validate=False)  # which refuses more than it cannot run
        self.variables = {variable.name: variable for variable in self.description.modelVariables}
        self.is_fmi1 = self.description.fmiVersion.startswith("1.")
        self.is_fmi3 = self.description.fmiVersion.startswith("3.")
        self.has_event_mode = self.is_fmi3 and bool(self.description.coSimulation.hasEventMode)
        self.folder = extract(path)
        self.fmu = instantiate_fmu(self.folder, self.description, "CoSimulation", event_mode_used=self.has_event_mode)

    def _call(self, verb, variable):
        kind = variable.type
        if kind == "Enumeration":
            kind = "Int64" if self.is_fmi3 else "Integer"
        return getattr(self.fmu, verb + kind)

    def get(self, name):
        """The value, a list of them for an array."""
        variable = self.variables[name]
        size = 1
        for extent in variable.shape or ():
            size *= extent
        sizes = {"nValues": size} if self.is_fmi3 else {}
        values = list(self._call("get", variable)([variable.valueReference], **sizes))
        if variable.type == "Boolean":
            values = [bool(value) for value in values]
        if variable.type == "String":
            values = [value if isinstance(value, str) else value.decode("utf-8") for value in values]
        return values if variable.shape else values[0]

    def set(self, name, value):
        variable = self.variables[name]
        self._call("set", variable)([variable.valueReference], value if variable.shape else [value])

    def initialize(self, values, stop):
        """Sets start values, those of an FMI 2.0 unit after its set-up, and enters Initialization Mode."""
        experiment = self.description.defaultExperiment
        tolerance = float(experiment.tolerance) if experiment and experiment.tolerance else None
        if not self.is_fmi1 and not self.is_fmi3:
            self.fmu.setupExperiment(tolerance=tolerance, startTime=0.0, stopTime=stop)
        for name, value in values.items():
            self.set(name, value)
        if self.is_fmi3:
            self.fmu.enterInitializationMode(tolerance=tolerance, startTime=0.0, stopTime=stop)
        elif self.is_fmi1:
            self.fmu.initialize(tStart=0.0, stopTime=stop)
        else:
            self.fmu.enterInitializationMode()

    def step(self, start, size):
        """Steps. Returns whether it has an event, and when the unit ended the simulation, if it did."""
        if self.is_fmi3:
            event, terminate, _, reached = self.fmu.doStep(start, size)
            return event, reached if terminate else None
        try:
            self.fmu.doStep(start, size)
        except FMICallException as answer:
            if answer.status != fmi2Discard or not self.fmu.getBooleanStatus(fmi2Terminated):
                raise
            return False, self.fmu.getRealStatus(fmi2LastSuccessfulTime)
        return False, None

    def handle_event(self):
        """One event iteration in Event Mode. Returns whether it needs another, and whether it wants the end."""
        more, terminate, *_ = self.fmu.updateDiscreteStates()
        return more, terminate

    def close(self):
        self.fmu.terminate()
        self.fmu.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


class Master:
    """A run of a stride_run.System; recorded are all outputs."""

    def __init__(self, system):
        self.system = system
        self.units = {name: Unit(path) for name, path in system.units.items()}
        self.wires = [(*source.split(".", 1), *target.split(".", 1)) for source, target in system.wires]
        self.table = {"time": []}
        self.given = {}  # what each input was set to last

    def run(self):
        points = self.system.points()  # exact, as are the sizes of the steps between them
        self._initialize(float(points[-1]))
        initial = {unit for unit in self.units.values() if unit.has_event_mode}
        end = self._settle(initial, in_event_mode=initial)
        self._record(float(points[0]))
        for start, target in zip(points, points[1:]):
            if end:
                break
            end = self._step(float(start), float(target), float(target - start))
        for unit in self.units.values():
            unit.close()
        return self.table

    def _initialize(self, stop):
        values = {name: {} for name in self.units}
        for name, value in self.system.start_values.items():
            unit, variable = name.split(".", 1)
            values[unit][variable] = value
        for name, unit in self.units.items():
            unit.initialize(values[name], stop)
        for _ in self.units:  # as often as a value can be handed on
            self._exchange(lambda _: True)
        if self._exchange(lambda _: True):
            raise RuntimeError("its initial values are an algebraic loop")
        for unit in self.units.values():
            if not unit.is_fmi1:
                unit.fmu.exitInitializationMode()

    def _step(self, start, target, size):
        self._exchange(lambda _: True)
        answers = {unit: unit.step(start, size) for unit in self.units.values()}
        end = self._settle({unit for unit, (event, _) in answers.items() if event})
        ended = [when for _, when in answers.values() if when is not None]
        self._record(min(ended, default=target))
        return end or bool(ended)

    def _settle(self, active, in_event_mode=frozenset()):
        """Events at a communication point, to a fixed point. Returns whether a unit wants the end."""
        end = False
        in_event_mode = set(in_event_mode)
        active = active | self._jumped()
        while active and not end:
            for unit in active - in_event_mode:
                unit.fmu.enterEventMode()
            in_event_mode |= active
            self._exchange(lambda unit: unit in in_event_mode)
            answers = {unit: unit.handle_event() for unit in active}
            active = {unit for unit, (more, _) in answers.items() if more} | self._jumped()
            end = any(terminate for _, terminate in answers.values())
        for unit in in_event_mode:
            unit.fmu.enterStepMode()
        return end

    def _fed(self, source, output, target, name):
        """The value for an input."""
        value = self.units[source].get(output)
        transformation = self.system.transformations.get(f"{target}.{name}")
        return transformation(value) if transformation else value

    def _jumped(self):
        """The units with Event Mode that have a discrete input which is to change."""
        return {self.units[target] for source, output, target, name in self.wires
                if self.units[target].has_event_mode and self.units[target].variables[name].variability == "discrete"
                and self.given.get((target, name)) != self._fed(source, output, target, name)}

    def _exchange(self, wanted):
        """Hands on the values that have changed. Returns whether there were any."""
        before = dict(self.given)
        values = [self._fed(*wire) for wire in self.wires]
        for value, (_, _, target, name) in zip(values, self.wires):
            if wanted(self.units[target]) and self.given.get((target, name)) != value:
                self.units[target].set(name, value)
                self.given[target, name] = value
        return self.given != before

    def _record(self, time):
        self.table["time"].append(time)
        for component, unit in self.units.items():
            for name, variable in unit.variables.items():
                if variable.causality != "output" or variable.type == "Clock" or variable.alias is not None:
                    continue
                value = unit.get(name)
                places = itertools.product(*(range(1, extent + 1) for extent in variable.shape or ()))
                for place, element in zip(places, value if variable.shape else [value]):
                    suffix = f"[{','.join(map(str, place))}]" if place else ""
                    self.table.setdefault(f"{component}.{name}{suffix}", []).append(element)
