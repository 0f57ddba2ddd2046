#!/usr/bin/env python3
"""The picture of the flagship run in docs/images is what docs/plot_run.py draws from the golden results, but for their
coarser steps: run_plot_test.py SOURCE_DIR"""

import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

STEP = 3.0  # 100 ms of the golden results, in units of the picture


def parts(svg):
    """(name, numbers, all else) of each element that is not a curve."""
    for element in xml.fromstring(svg):
        name = element.tag.rsplit("}", 1)[-1]
        if name == "polygon":
            continue
        numbers, rest = [], [element.text]
        for key, value in sorted(element.attrib.items()):
            try:
                numbers.append(float(value))
            except ValueError:
                rest.append((key, value))
        yield name, numbers, rest


def differences(drawn, shown):
    drawn, shown = list(parts(drawn)), list(parts(shown))
    if len(drawn) != len(shown):
        yield f"{len(drawn)} elements are drawn, {len(shown)} are shown"
    for one, other in zip(drawn, shown):
        near = len(one[1]) == len(other[1]) and all(abs(a - b) <= STEP for a, b in zip(one[1], other[1]))
        if one[0] != other[0] or one[2] != other[2] or not near:
            yield f"drawn {one}, shown {other}"


def main(root):
    root = Path(root)
    drawn = subprocess.run([sys.executable, root / "docs/plot_run.py", root / "scenarios/nfc_approach/golden"],
                           check=True, capture_output=True, text=True, encoding="utf-8").stdout
    found = list(differences(drawn, (root / "docs/images/nfc_approach.svg").read_text(encoding="utf-8")))
    if found:
        sys.exit("docs/images/nfc_approach.svg is not of the golden run; draw it anew:\n" + "\n".join(found))


if __name__ == "__main__":
    main(*sys.argv[1:])
