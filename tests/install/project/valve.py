import stride.unit as su

from curve import flow


class Valve(su.Unit):
    """Opens with the pressure."""

    pressure = su.Input(float, unit="Pa")
    flow = su.Output(float, unit="m3/s")

    def step(self, now, end):
        self.flow = flow(self.pressure)


class Closed(Valve):
    def step(self, now, end):
        self.flow = 0.0
