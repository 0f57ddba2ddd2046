"""A low-pass filter whose step is exact for an input that is held; made into an FMU by PythonFMU."""

import math

from pythonfmu import DefaultExperiment, Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Real


class LowPassFmi2(Fmi2Slave):

    description = "y' = (u - y) / time_constant"

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.default_experiment = DefaultExperiment(start_time=0.0, stop_time=1.0, step_size=0.125)
        self.u = 0.0
        self.y = 0.0
        self.time_constant = 0.5
        self.register_variable(Real("u", causality=Fmi2Causality.input, variability=Fmi2Variability.continuous))
        self.register_variable(
            Real("time_constant", causality=Fmi2Causality.parameter, variability=Fmi2Variability.fixed))
        self.register_variable(Real("y", causality=Fmi2Causality.output, variability=Fmi2Variability.continuous,
                                    initial=Fmi2Initial.exact))

    def do_step(self, current_time, step_size):
        self.y += (self.u - self.y) * -math.expm1(-step_size / self.time_constant)
        return True
