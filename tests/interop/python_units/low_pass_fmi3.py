"""A low-pass filter whose step is exact for an input that is held; made into an FMU by PythonFMU3."""

import math

from pythonfmu3 import DefaultExperiment, Float64, Fmi3Causality, Fmi3Initial, Fmi3Slave, Fmi3Variability


class LowPassFmi3(Fmi3Slave):

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.description = "y' = (u - y) / time_constant"
        self.default_experiment = DefaultExperiment(start_time=0.0, stop_time=1.0, step_size=0.125)
        self.time = 0.0
        self.u = 0.0
        self.y = 0.0
        self.time_constant = 0.5
        self.register_variable(
            Float64("time", causality=Fmi3Causality.independent, variability=Fmi3Variability.continuous))
        self.register_variable(Float64("u", causality=Fmi3Causality.input, variability=Fmi3Variability.continuous))
        self.register_variable(
            Float64("time_constant", causality=Fmi3Causality.parameter, variability=Fmi3Variability.fixed))
        self.register_variable(Float64("y", causality=Fmi3Causality.output, variability=Fmi3Variability.continuous,
                                       initial=Fmi3Initial.exact))

    def do_step(self, current_time, step_size):
        self.y += (self.u - self.y) * -math.expm1(-step_size / self.time_constant)
        self.time = current_time + step_size
        return True
