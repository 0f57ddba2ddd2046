"""scenario_test.py STRIDE SCENARIO FOLDER: the program runs the scenario, and its results begin as the page shows them.

Numbers may differ by rounding, because the last digit of exp() and its kin is the C library's.
"""

import math
import pathlib
import re
import shutil
import subprocess
import sys


def is_same(word, expected):
    try:
        return math.isclose(float(word), float(expected), rel_tol=1e-12, abs_tol=1e-15)
    except ValueError:
        return word == expected


def words(line):
    return re.split(r"([,\s])", line)


def differences(found, expected):
    for number, wanted in enumerate(expected):
        line = found[number] if number < len(found) else ""
        pairs = list(zip(words(line), words(wanted)))
        if len(words(line)) != len(words(wanted)) or not all(is_same(*pair) for pair in pairs):
            yield f"line {number + 1} is\n    {line}\n  the page says\n    {wanted}"


def main(program, scenario, folder):
    scenario, folder = pathlib.Path(scenario), pathlib.Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    status = subprocess.run([program, "run", scenario, "--out", folder, "--quiet"], check=False).returncode
    if status != 0:
        print(f"stride run ended with the exit code {status}")
        return 1
    if not any(folder.iterdir()):
        print("the run left no result")
        return 1
    mistakes = 0
    for expected in sorted(scenario.with_suffix(".expected").glob("*")):
        found = (folder / expected.name).read_text(encoding="utf-8").splitlines()
        for difference in differences(found, expected.read_text(encoding="utf-8").splitlines()):
            print(f"{expected.name}: {difference}")
            mistakes += 1
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
