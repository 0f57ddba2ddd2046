"""film_test.py FMU FOLDER: FMPy drives a mujoco_world that makes a film, without stride and without STRIDE_RESULTS;
Pillow reads its pictures. FMU is the pendulum, which swings from the right to the left."""

import csv
import ctypes
import os
import pathlib
import shutil
import sys

import numpy as np
from PIL import Image
from fmpy import simulate_fmu

SIZE = (96, 64)
STOP, INTERVAL = 1.0, 0.25


def pictures(folder):
    """(time [s], pixels) of each frame of a film."""
    with open(folder / "frames.csv", newline="") as file:
        return [(row["time"], Image.open(folder / row["file"])) for row in csv.DictReader(file)]


def run(fmu, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    os.environ.pop("STRIDE_RESULTS", None)
    os.chdir(folder)
    simulate_fmu(fmu, stop_time=STOP, output_interval=0.01, start_values={
        "film.interval": INTERVAL, "film.width": SIZE[0], "film.height": SIZE[1]})
    films = list((folder / "film").iterdir())
    assert len(films) == 1, films
    return pictures(films[0])


def has_open_gl():
    for library in ("libOSMesa.so.8", "libEGL.so.1"):
        try:
            ctypes.CDLL(library)
            return True
        except OSError as error:
            print(error)
    return False


def main(fmu, folder):
    if not has_open_gl():
        print("SKIPPED: there is no OpenGL to draw with")
        return 1 if os.environ.get("CI") == "true" else 77
    frames = run(os.path.abspath(fmu), pathlib.Path(folder).absolute())
    assert [time for time, _ in frames] == ["0", "0.25", "0.5", "0.75", "1"], frames
    for time, picture in frames:
        assert (picture.format, picture.mode, picture.size) == ("JPEG", "RGB", SIZE), (time, picture)
    pixels = [np.asarray(picture, dtype=int) for _, picture in frames]
    for one, other in zip(pixels, pixels[1:]):
        assert np.abs(one - other).max() > 50, "the pendulum does not move"
    print(f"{len(frames)} pictures")
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
