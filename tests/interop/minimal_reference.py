"""minimal_reference.py FMU: with inputs, FMPy's result of the low-pass agrees with the closed form."""

import sys

import numpy as np
from fmpy import simulate_fmu


def main(path):
    times = np.array([0.0, 1.0])
    signals = np.array([(t, 1.0) for t in times], dtype=[("time", float), ("u", float)])
    result = simulate_fmu(path, stop_time=1.0, output_interval=0.01, input=signals, output=["y"],
                          start_values={"time_constant": 0.25})
    error = np.max(np.abs(result["y"] - (1 - np.exp(-result["time"] / 0.25))))
    print(f"largest error {error:.3g}")
    return 0 if error < 1e-9 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
