"""y' = u, in Python."""

import stride.unit as su


class Integrator(su.Unit):
    """y' = u"""

    u = su.Input(float)
    y = su.Output(float)

    def step(self, now, end):
        self.y += self.u * (end - now)
