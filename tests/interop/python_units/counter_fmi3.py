"""A variable of each type that PythonFMU3 has, inputs and outputs, with limits to misbehave at: it rejects steps longer
than longest_step, ends the simulation at end, and raises an error at failure, all in seconds."""

from pythonfmu3 import (Boolean, DefaultExperiment, Float64, Fmi3Causality, Fmi3Initial, Fmi3Slave, Fmi3Status,
                        Fmi3StepResult, Fmi3Variability, Int32, Int64, String, UInt64)


class CounterFmi3(Fmi3Slave):

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.default_experiment = DefaultExperiment(start_time=0.0, stop_time=1.0, step_size=0.1)
        self.time = 0.0
        self.up = True
        self.stride = 1
        self.label = "µ<&>"
        self.steps = 0
        self.big = -9007199254740993
        self.bits = 2**63
        self.running = True
        self.text = ""
        self.simulated = 0.0
        self.longest_step = 10.0
        self.end = 10.0
        self.failure = 10.0
        self.register_variable(
            Float64("time", causality=Fmi3Causality.independent, variability=Fmi3Variability.continuous))
        for kind, name in ((Boolean, "up"), (Int32, "stride"), (String, "label")):
            self.register_variable(kind(name, causality=Fmi3Causality.input, variability=Fmi3Variability.discrete))
        for kind, name in ((Int32, "steps"), (Int64, "big"), (UInt64, "bits"), (Boolean, "running"), (String, "text")):
            self.register_variable(kind(name, causality=Fmi3Causality.output, variability=Fmi3Variability.discrete,
                                        initial=Fmi3Initial.exact))
        self.register_variable(Float64("simulated", causality=Fmi3Causality.output,
                                       variability=Fmi3Variability.continuous, initial=Fmi3Initial.exact))
        for name in ("longest_step", "end", "failure"):
            self.register_variable(
                Float64(name, causality=Fmi3Causality.parameter, variability=Fmi3Variability.fixed))

    def do_step(self, current_time, step_size):
        if step_size > self.longest_step:
            return Fmi3StepResult(status=Fmi3Status.discard)
        self.time = current_time + step_size
        if self.time > self.failure - 1e-9:
            raise RuntimeError(f"made to fail at {self.failure} s")
        self.steps += self.stride if self.up else -self.stride
        self.big += self.steps
        self.bits = int(getattr(self.bits, "value", self.bits)) ^ self.steps
        self.running = not self.running
        self.text = f"{self.label} {self.steps}"
        self.simulated += step_size
        return Fmi3StepResult(terminateSimulation=self.time > self.end - 1e-9)
