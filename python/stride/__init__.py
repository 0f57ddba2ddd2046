"""stride, a co-simulation master: FMI units, wired and run as an SSP scenario says.

    run = stride.run("nfc_approach")                     # a run, to its end
    run.signals["sensor.capacitor.voltage"]              # a numpy array
    run.verdicts                                         # of units and checks

    with stride.Simulation("x.ssd") as sim:              # step by step
        sim.step(until=1.5)
        sim["sensor.led"]

    stride.campaign("variations.xosc")                   # many of them

The program is on the PATH of the environment as `stride`; `python -m stride` is the same.
"""

from ._errors import Error, InputError, MisuseError, RunError
from ._program import Campaign, campaign, program, run
from .results import Run, Signals
from .simulation import Message, Simulation, Variable, Verdict

__all__ = [
    "Campaign",
    "Error",
    "InputError",
    "Message",
    "MisuseError",
    "Run",
    "RunError",
    "Signals",
    "Simulation",
    "Variable",
    "Verdict",
    "campaign",
    "program",
    "run",
]
