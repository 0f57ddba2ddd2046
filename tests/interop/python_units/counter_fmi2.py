"""A variable of each type that PythonFMU has, inputs and outputs, with limits to misbehave at: it ends the simulation
behind end, and raises an error at failure, both in seconds."""

from pythonfmu import (Boolean, DefaultExperiment, Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Integer, Real,
                       String)


class CounterFmi2(Fmi2Slave):

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.default_experiment = DefaultExperiment(start_time=0.0, stop_time=1.0, step_size=0.1)
        self.up = True
        self.stride = 1
        self.label = "µ<&>"
        self.steps = 0
        self.running = True
        self.text = ""
        self.simulated = 0.0
        self.end = 10.0
        self.failure = 10.0
        for kind, name in ((Boolean, "up"), (Integer, "stride"), (String, "label")):
            self.register_variable(kind(name, causality=Fmi2Causality.input, variability=Fmi2Variability.discrete))
        for kind, name in ((Integer, "steps"), (Boolean, "running"), (String, "text")):
            self.register_variable(kind(name, causality=Fmi2Causality.output, variability=Fmi2Variability.discrete,
                                        initial=Fmi2Initial.exact))
        self.register_variable(Real("simulated", causality=Fmi2Causality.output,
                                    variability=Fmi2Variability.continuous, initial=Fmi2Initial.exact))
        for name in ("end", "failure"):
            self.register_variable(
                Real(name, causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed))

    def do_step(self, current_time, step_size):
        if current_time + step_size > self.end + 1e-9:
            return False  # fmi2Discard, and fmi2Terminated
        if current_time + step_size > self.failure - 1e-9:
            raise RuntimeError(f"made to fail at {self.failure} s")
        self.steps += self.stride if self.up else -self.stride
        self.running = not self.running
        self.text = f"{self.label} {self.steps}"
        self.simulated += step_size
        return True
