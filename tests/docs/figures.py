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


def fade(run):
    """When the field can no longer hold the rail at its maximum."""
    return run.first(25.1, "sensor.supply.voltage", lambda value: value < 5)


def value(time, signal, factor=1.0):
    return lambda run: factor * run.at(time, signal)


def least(begin, end, signal, factor=1.0):
    return lambda run: factor * run.between(begin, end, signal)[0]


def most(begin, end, signal, factor=1.0):
    return lambda run: factor * run.between(begin, end, signal)[1]


def lost(begin, end):
    """Of the charge [µC]."""
    return lambda run: 1e6 * (run.at(begin, "sensor.capacitor.charge") - run.at(end, "sensor.capacitor.charge"))


PAPER = "docs/paper.md"
SCENARIO = "scenarios/nfc_approach/README.md"
POWER, VOLTAGE = "channel.tag_power", "channel.tag_voltage"
INTAKE, LOAD = "sensor.energy.intake", "sensor.energy.load"
LED = {"least_load": least(14.21, 14.85, LOAD, 1e3), "most_load": most(14.21, 14.85, LOAD, 1e3),
       "least": least(14.21, 14.85, INTAKE, 1e3), "most": most(14.21, 14.85, INTAKE, 1e3)}

FIGURES = [
    (PAPER, "6.5 s: not heard, for the tag's antenna has {voltage:.1f} V", {"voltage": value(6.5, VOLTAGE)}),
    (PAPER, "8.0 s: {voltage:.1f} V, {bits} wrong bits, so the parity fails. EnergyIntake {least:.0f} to {most:.1f} µW, "
     "from {begin:.3f} s on",
     {"voltage": value(8, VOLTAGE), "bits": wrong_bits, "least": least(6.101, 8.999, INTAKE, 1e6),
      "most": most(6.101, 8.999, INTAKE, 1e6), "begin": lambda run: run.first(6.1, INTAKE, lambda power: power > 0)}),
    (PAPER, "Voltage floats, up to {voltage:.1f} V", {"voltage": most(6.101, 8.999, "sensor.supply.voltage")}),
    (PAPER, "6 cm away with {power:.1f} mW available at the tag; the answer begins {delay:.2f} ms after the request began",
     {"power": value(14.2, POWER, 1e3), "delay": lambda run: 1e3 * (run.sent("sensor", 14.2) - 14.2)}),
    (PAPER, "the sensor takes {least_load:.1f} to {most_load:.1f} mW and gets {least:.1f} to {most:.1f} mW: "
     "brown-out at {time:.3f} s", {**LED, "time": brown_out}),
    (PAPER, "Charge rises to {voltage:.1f} V", {"voltage": value(15.499, "sensor.capacitor.voltage")}),
    (PAPER, "{power:.1f} mW at 2.5 cm, {ratio:.1f} times as much as at the end of 3; the sensor starts at {start:.3f} s, "
     "the capacitor is full at {full:.2f} s",
     {"power": most(20.98, 21.3, INTAKE, 1e3), "start": start, "full": full,
      "ratio": lambda run: run.between(20.98, 21.3, INTAKE)[1] / run.at(15.499, INTAKE)}),
    (PAPER, "EnergyIntake settles at what the sensor takes, {power:.1f} µW", {"power": value(23, INTAKE, 1e6)}),
    (PAPER, "Charge stays full until {time:.1f} s, {distance:.1f} cm away, and falls from there by {percent:.1f} %",
     {"time": fade, "distance": lambda run: 100 * run.at(fade(run), "channel.distance"),
      "percent": lambda run: lost(25, 30)(run) / run.at(25, "sensor.capacitor.charge") * 1e-4}),
    (PAPER, "by {first:.0f} µC in the\nfirst 6 s, in stop mode, and by {second:.1f} µC from 15.6 to 20.8 s",
     {"first": lost(0, 6), "second": lost(15.6, 20.8)}),
    (PAPER, "each with a probability\nof {percent:.0f} %", {"percent": value(8, "channel.bit_error_rate.down", 100)}),
    (SCENARIO, "the tag's antenna has {first:.1f} V, and its demodulator needs 3.6 V; then {second:.1f} V, but {bits} bits "
     "are wrong", {"first": value(6.5, VOLTAGE), "second": value(8, VOLTAGE), "bits": wrong_bits}),
    (SCENARIO, "{power:.1f} mW available at 6 cm", {"power": value(14.2, POWER, 1e3)}),
    (SCENARIO, "| {time:.3f} | the sensor switches off | with the LED it takes {least_load:.1f} to {most_load:.1f} mW and "
     "gets {least:.1f} to {most:.1f} mW", {**LED, "time": brown_out}),
    (SCENARIO, "| {time:.3f} | the sensor starts again | {power:.1f} mW at 2.5 cm charge the capacitor, which is full at "
     "{full:.2f} s |", {"time": start, "full": full, "power": most(20.98, 21.3, INTAKE, 1e3)}),
    (SCENARIO, "the reader has {measured:.2f} °C, the environment {truth:.3f} °C",
     {"measured": value(30, "reader.measured.temperature"), "truth": value(24, "environment.temperature")}),
    (SCENARIO, "from {time:.1f} s on the field cannot hold the rail at 5 V", {"time": fade}),
]
