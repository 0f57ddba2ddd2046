"""tables_test.py STRIDE MINIMAL FOLDER: a unit that follows a table in stride has the outputs that it has in FMPy with the
same file as its input. Results go into FOLDER."""

import pathlib
import sys

import numpy as np
from fmpy import simulate_fmu
from fmpy.util import read_csv
from stride_run import System, run_system

# beginning before the run, with a kink between the communication points, jumps beside them and at one, and ending before
# the run does
TABLE = """time,u
-1,2
0.25,-1
0.33,4
0.77,4
0.77,-2
1.2,1
1.2,3
1.5,4
1.75,0.5
"""


def main(program, minimal, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    table = folder / "profile.csv"
    table.write_text(TABLE, encoding="utf-8")
    system = System({"profile": table, "filter": minimal}, [("profile.u", "filter.u")], step="0.1", stop="2")
    ours = run_system(program, system, folder / "stride", "--start", "0")
    theirs = simulate_fmu(str(minimal), stop_time=2, step_size=0.1, output_interval=0.1, input=read_csv(str(table)),
                          output=["y"])
    by_time = {round(float(time), 9): float(y) for time, y in zip(ours["time"], ours["filter.y"])}
    missing = [time for time in theirs["time"] if round(time, 9) not in by_time]
    error = max(abs(y - by_time.get(round(time, 9), np.inf)) for time, y in zip(theirs["time"], theirs["y"]))
    print(f"{len(theirs)} rows, without a counterpart at {missing}, largest difference {error:.3g}")
    return 0 if error < 1e-12 else 1


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
