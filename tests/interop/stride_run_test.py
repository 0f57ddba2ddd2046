"""Whoever compares results has to see where they differ: differences() of stride_run.py finds each kind of mistake."""

import sys

from stride_run import System, differences, text_of

OURS = {"time": ["0", "0.1", "0.2"], "a.y": ["1", "0.9", "0.81"], "a.on": ["true", "true", "false"],
        "a.name": ["x", "x", "y"], "a.data": ["666f", "", "00"], "a.count": ["1", "2", "9007199254740993"]}
GOOD = {"time": [0.0, 0.1, 0.2], "a.y": [1.0, 0.9, 0.81], "a.on": [True, True, False],
        "a.name": ["x", "x", "y"], "a.data": [b"fo", b"", b"\0"], "a.count": [1, 2, 9007199254740993]}

WRONG = [({"a.y": [1.0, 0.9, 0.8100000000000002]}, "a.y at 0.2 s is 0.81, expected 0.8100000000000002"),
         ({"a.on": [True, False, False]}, "a.on at 0.1 s is true, expected False"),
         ({"a.name": ["x", "X", "y"]}, "a.name at 0.1 s is x, expected 'X'"),
         ({"a.data": [b"fo", b"f", b"\0"]}, "a.data at 0.1 s is , expected b'f'"),
         ({"a.count": [1, 2, 9007199254740992]}, "a.count at 0.2 s is 9007199254740993, expected 9007199254740992"),
         ({"a.z": [1.0, 2.0, 3.0]}, "there is no column 'a.z'"),
         ({"time": [0.0, 0.1, 0.3]}, "there is no row at 0.3 s, the nearest is at 0.2 s")]


def main():
    mistakes = 0
    cases = [(GOOD, 0.0, []), ({"time": [0.2], "a.y": [0.81 + 1e-10]}, 1e-9, []),
             *(({**GOOD, **change}, 0.0, [text]) for change, text in WRONG)]
    for expected, tolerance, texts in cases:
        found = differences(OURS, expected, tolerance)
        if found != texts:
            print(f"{expected}: found {found}, expected {texts}")
            mistakes += 1
    points = [float(point) for point in System({}, step="0.1", stop="0.35").points()]
    if points != [0.0, 0.1, 0.2, 0.3, 0.35] or text_of([True, 1.5]) != "true 1.5":
        print(f"points {points}")
        mistakes += 1
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main())
