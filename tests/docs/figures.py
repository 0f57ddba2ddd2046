"""Sentences in the documentation whose numbers come from a run of nfc_approach: page, text, and how each number follows
from the run (figures_test.Run)."""

FULL = 0.999  # of the final charge


def full(run):
    charge = run.at(25, "sensor.capacitor.charge")
    return run.first(20.9, "sensor.capacitor.charge", lambda value: value >= FULL * charge)


def start(run):
    return run.first(15.5, "sensor.mcu.powered", lambda value: value == 1)


def brown_out(run):
    return run.first(14.2, "sensor.mcu.powered", lambda value: value == 0)


def in_words(count):
    return ("no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine")[count]


def wrong_bits(run):
    return in_words(run.wrong_bits(8))


def microwatts(time, signal):
    return lambda run: 1e6 * run.at(time, signal)


PAPER = "docs/paper.md"
SCENARIO = "scenarios/nfc_approach/README.md"
POWER, INTAKE = "channel.tag_power", "sensor.energy.intake"

FIGURES = [
    (PAPER, "6.5 s: not received, for {power:.1f} µW reach the tag", {"power": microwatts(6.5, POWER)}),
    (PAPER, "8.0 s: {power:.1f} µW, {bits} wrong bits, so the parity fails. EnergyIntake {least:.2f} to {most:.1f} µW",
     {"power": microwatts(8, POWER), "bits": wrong_bits,
      "least": lambda run: 1e6 * run.between(6.101, 8.999, INTAKE)[0],
      "most": lambda run: 1e6 * run.between(6.101, 8.999, INTAKE)[1]}),
    (PAPER, "6 cm away with {power:.2f} mW at the tag; the answer begins {delay:.2f} ms after the request began",
     {"power": lambda run: 1e3 * run.at(14.2, POWER),
      "delay": lambda run: 1e3 * (run.sent("sensor", 14.2) - 14.2)}),
    (PAPER, "brown-out at {time:.3f} s", {"time": brown_out}),
    (PAPER, "{power:.1f} mW at 2.5 cm, {ratio:.1f} times as much as at the end of 3; the sensor starts at {start:.3f} s, "
     "the capacitor is full at {full:.2f} s",
     {"power": lambda run: 1e3 * run.between(20.95, 21.1, INTAKE)[1],
      "ratio": lambda run: run.between(20.95, 21.1, INTAKE)[1] / run.at(15.499, INTAKE),
      "start": start, "full": full}),
    (PAPER, "EnergyIntake is only what the sensor takes, {power:.1f} µW", {"power": microwatts(24.05, INTAKE)}),
    (SCENARIO, "{least:.1f} µW reach the tag, which receives from 1 µW on; then {most:.0f} µW, but {bits} bits are wrong",
     {"least": microwatts(6.5, POWER), "most": microwatts(8, POWER), "bits": wrong_bits}),
    (SCENARIO, "| {time:.3f} | the sensor switches off |", {"time": brown_out}),
    (SCENARIO, "| {time:.3f} | the sensor starts again | {power:.1f} mW at 2.5 cm charge the capacitor, which is full at "
     "{full:.2f} s |",
     {"time": start, "full": full, "power": lambda run: 1e3 * run.at(24, POWER)}),
]
