#!/usr/bin/env python3
"""Puts pictures of a film side by side, as an SVG picture that contains them:
docs/plot_film.py results/nfc_approach/units/world/film 0 14.2 24 > docs/images/film.svg

Needs nothing but Python. The numbers are times [s], of which the film must have a picture.
"""

import base64
import csv
import struct
import sys
from pathlib import Path

GAP, LABEL = 6, 20


def size_of(jpeg):
    """Width and height, of the segment that begins a frame (ISO/IEC 10918-1, B.2.2)."""
    at = 2
    while jpeg[at + 1] not in (0xC0, 0xC1, 0xC2):
        at += 2 + struct.unpack_from(">H", jpeg, at + 2)[0]
    height, width = struct.unpack_from(">HH", jpeg, at + 5)
    return width, height


def chosen(film, times):
    """The picture of each time."""
    with open(film / "frames.csv", newline="", encoding="utf-8") as file:
        files = {row["time"]: row["file"] for row in csv.DictReader(file)}
    missing = [time for time in times if time not in files]
    if missing:
        begin = ", ".join(list(files)[:3])
        sys.exit(f"{film} has no picture at {', '.join(missing)} s; its {len(files)} are at {begin} … {list(files)[-1]} s")
    return [(film / files[time]).read_bytes() for time in times]


def draw(times, jpegs):
    width, height = size_of(jpegs[0])
    whole = (width + GAP) * len(jpegs) - GAP
    yield f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {whole} {height + LABEL}" font-family="sans-serif">'
    for i, (time, jpeg) in enumerate(zip(times, jpegs)):
        left = i * (width + GAP)
        data = base64.b64encode(jpeg).decode("ascii")
        yield f'<image x="{left}" width="{width}" height="{height}" href="data:image/jpeg;base64,{data}"/>'
        yield (f'<text x="{left + width / 2:g}" y="{height + 15}" font-size="13" fill="#888" text-anchor="middle">'
               f"{time} s</text>")
    yield "</svg>"


def main(film, *times):
    print("\n".join(draw(times, chosen(Path(film), times))))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
