#!/usr/bin/env python3
"""Runs seeded variations of the scenario nfc_jitter and sums up how many exchanges succeed, as a page in Markdown:
docs/variations.py > docs/variations.md

Each run differs in the seed of tremor and start position, and in the tremor's amplitude. Fails, naming the runs, if one
ends with an error."""

import argparse
import concurrent.futures
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCENARIO = ROOT / "scenarios" / "nfc_jitter" / "nfc_jitter.ssd"
AMPLITUDES = [0, 0.004, 0.01, 0.02]  # of the axis that trembles most [rad]
FARTHEST = 12  # [cm]; what is beyond is one class
REPORT = re.compile(r"at (\S+) s \S+: expected .*; got (.*) after \d+ tr(?:y|ies)")


def rows(file):
    with open(file, encoding="utf-8", newline="") as lines:
        yield from csv.DictReader(lines)


def exchanges(folder):
    """(distance [m] of the coils when it was sent, what the reader got) of each command."""
    distance = {row["time"]: float(row["channel.distance [m]"]) for row in rows(folder / "signals.csv")}
    for event in rows(folder / "events.csv"):
        if event["variable"] != "report.text":
            continue
        sent_at, got = REPORT.match(event["payload"]).groups()
        outcome = "answered" if got.startswith("ok") else "damaged" if "damaged" in got else "silence"
        yield distance[sent_at], outcome


def run(program, seed, amplitude):
    """The exchanges of one run, or a text if it failed."""
    with tempfile.TemporaryDirectory(prefix="stride-variation-") as folder:
        settings = [f"reader.seed={seed}", f"reader.tremor.amplitude={amplitude}"]
        command = [program, "run", SCENARIO, "--quiet", "--no-trace", "--out", folder, "--signals", "channel.distance"]
        command += [word for setting in settings for word in ("--set", setting)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            return f"{' '.join(settings)}: {done.stderr.strip()}"
        return list(exchanges(pathlib.Path(folder)))


def table(titles, lines):
    yield "| " + " | ".join(titles) + " |"
    yield "|" + "---|" * len(titles)
    yield from ("| " + " | ".join(line) + " |" for line in lines)


def share(part, whole):
    return f"{part} of {whole}" if whole else "–"


def class_of(distance):
    """Whole centimetres."""
    return min(int(100 * distance), FARTHEST)


def by_distance(results):
    """Rows: classes of distance; columns: amplitudes."""
    for each in sorted({class_of(distance) for found in results.values() for distance, _ in found}):
        line = [f"{each} – {each + 1}" if each < FARTHEST else f"{each} and more"]
        for amplitude in AMPLITUDES:
            inside = [outcome for distance, outcome in results[amplitude] if class_of(distance) == each]
            line.append(share(inside.count("answered"), len(inside)))
        yield line


def by_amplitude(results, runs):
    for amplitude in AMPLITUDES:
        found = results[amplitude]
        outcomes = [outcome for _, outcome in found]
        answered = [distance for distance, outcome in found if outcome == "answered"]
        missed = [distance for distance, outcome in found if outcome != "answered"]
        yield [f"{amplitude}", str(runs[amplitude]), share(len(answered), len(found)), str(outcomes.count("damaged")),
               str(outcomes.count("silence")), f"{100 * max(answered):.1f}" if answered else "–",
               f"{100 * min(missed):.1f}" if missed else "–"]


def page(results, runs):
    total = sum(runs.values())
    yield "# Variations of an approach\n"
    yield "This page shows how far the sensor answers when a hand trembles. [variations.py](variations.py) made"
    yield f"{total} runs of [nfc_jitter](../scenarios/nfc_jitter), in each of which a hand brings the reader to the sensor"
    yield "and asks `identify` on the way. The seed decides where the hand begins and how it trembles. No run ended with an"
    yield "error.\n"
    yield "By the tremor's amplitude, which is that of the axis that trembles most:\n"
    yield from table(["amplitude [rad]", "runs", "answered", "damaged answers", "silence", "farthest answer [cm]",
                      "nearest miss [cm]"], by_amplitude(results, runs))
    yield "\nAnswered, by the distance of the coils' centers at which it was asked, and by the amplitude:\n"
    yield from table(["distance [cm]", *(f"{amplitude} rad" for amplitude in AMPLITUDES)], by_distance(results))


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--program", default=ROOT / "build/release/bin/stride", help="the program stride")
    options.add_argument("--runs", type=int, default=200, help="how many in all")
    options.add_argument("--jobs", type=int, default=2, help="how many at once")
    chosen = options.parse_args()

    jobs = [(seed, AMPLITUDES[seed % len(AMPLITUDES)]) for seed in range(1, chosen.runs + 1)]
    with concurrent.futures.ThreadPoolExecutor(chosen.jobs) as pool:
        found = list(pool.map(lambda job: run(chosen.program, *job), jobs))
    failures = [each for each in found if isinstance(each, str)]
    if failures:
        print("\n".join(failures), file=sys.stderr)
        return 1
    results = {amplitude: [] for amplitude in AMPLITUDES}
    runs = dict.fromkeys(AMPLITUDES, 0)
    for (_, amplitude), exchanged in zip(jobs, found):
        results[amplitude] += exchanged
        runs[amplitude] += 1
    print("\n".join(page(results, runs)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
