#!/usr/bin/env python3
"""Draws what the unit rf_channel gives over distance, over the ratio of signal to noise and over a dipole's tilt, from
the unit itself.

    docs/plot_rf_channel.py > docs/images/rf_channel.svg
    docs/plot_rf_channel.py --table            # the table in units/rf_channel/README.md

--program names the program stride, build/release/bin/stride unless given. Needs nothing but Python.
"""

import math

from plot_channel import Panel, curves, main, run, text_of_rate

POWER = 1e-3  # W
TABLE = [0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500]
ORANGE, BLUE, GREEN = "#c05621", "#1b6ca8", "#2f855a"


def link(distance, heights=(0.5, 0.5), **parameters):
    """Start values of a reader at x = 0 and a tag at x = distance, of these heights [m]."""
    values = {"carrier_power": POWER, "reader_coil.position.z": heights[0], "tag_coil.position.x": distance,
              "tag_coil.position.z": heights[1]}
    values.update((name.replace("__", "."), value) for name, value in parameters.items())
    return values


def outputs(program, links):
    points = run(program, links, "rf_channel")
    for point in points:
        point["gain"] = point["coupling"] ** 2
    return points


def table(program):
    yield "| distance | received | `snr.down` | errors | `snr.down`, GFSK | errors, GFSK |"
    yield "|---|---|---|---|---|---|"
    oqpsk = outputs(program, [link(d) for d in TABLE])
    gfsk = outputs(program, [link(d, modulation="gfsk") for d in TABLE])
    for distance, p, q in zip(TABLE, oqpsk, gfsk):
        received = 10 * math.log10(POWER / 1e-3 * p["gain"])
        yield (f"| {distance:g} m | {received:.0f} dBm | {p['snr.down']:.0f} dB | "
               f"{text_of_rate(p['bit_error_rate.down'])} | {q['snr.down']:.0f} dB | "
               f"{text_of_rate(q['bit_error_rate.down'])} |")


def panel_of_distance(parts, program):
    distances = [0.02 * i for i in range(10, 1001)]
    panel = Panel(parts, 60, 40, "received / sent power, antennas 0.5 m high", (0, 20), 5, "distance [m]", (-10, -1))
    for row, (text, colour, parameters) in enumerate([
            ("free space", GREEN, {"ground__reflects": False}),
            ("two rays, horizontal field", BLUE, {"antenna": "isotropic_horizontal"}),
            ("two rays, vertical field", ORANGE, {"antenna": "isotropic_vertical"})]):
        points = outputs(program, [link(d, **parameters) for d in distances])
        panel.curve(curves(distances, points, "gain"), colour)
        panel.key(row, text, colour)


def panel_of_bench(parts, program):
    distances = [0.005 * i for i in range(30, 161)]
    panel = Panel(parts, 490, 40, "the same 0.3 and 0.1 m above metal, dipoles", (10, 80), 10, "distance [cm]", (-6, -1))
    metal = {"antenna": "dipole", "ground__permittivity": 1.0, "ground__conductivity": 1e7}
    across = {f"{coil}__axis__{axis}": float(axis == "y") for coil in ("reader_coil", "tag_coil") for axis in "yz"}
    for row, (text, colour, axes) in enumerate([("upright", ORANGE, {}), ("across", BLUE, across)]):
        points = outputs(program, [link(d, (0.3, 0.1), **metal, **axes) for d in distances])
        panel.curve(curves([100 * d for d in distances], points, "gain"), colour)
        panel.key(row, text, colour)


def panel_of_errors(parts, program):
    interference = [10 ** (-2 - 0.025 * i) for i in range(0, 200)]
    panel = Panel(parts, 60, 310, "bit error rate", (-10, 20), 5, "signal to noise and interference [dB]", (-10, 0))
    for row, (text, colour) in enumerate([("gfsk", GREEN), ("oqpsk", BLUE)]):
        points = outputs(program, [link(1.0, tag__interference=i, modulation=text, ground__reflects=False,
                                        reader__antenna_gain=20.0, tag__antenna_gain=20.0) for i in interference])
        panel.curve([(p["snr.down"], p["bit_error_rate.down"]) for p in points], colour)
        panel.key(row, text, colour)


def panel_of_tilt(parts, program):
    tilts = range(0, 91)
    panel = Panel(parts, 490, 310, "received / sent power, a dipole tilted towards the other", (0, 90), 15,
                  "tilt [degrees]", (-9, -4))
    for row, (text, colour, reflects) in enumerate([("free space", GREEN, False), ("two rays", ORANGE, True)]):
        points = outputs(program, [link(1.5, antenna="dipole", ground__reflects=reflects,
                                        tag_coil__axis__x=math.sin(math.radians(t)),
                                        tag_coil__axis__z=math.cos(math.radians(t))) for t in tilts])
        panel.curve(curves(tilts, points, "gain"), colour)
        panel.key(row, text, colour)


def picture(program):
    parts = ['<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 860 566" font-size="12" font-family="sans-serif">',
             '<rect width="860" height="566" fill="#fff"/>']
    for panel in (panel_of_distance, panel_of_bench, panel_of_errors, panel_of_tilt):
        panel(parts, program)
    return "\n".join(parts + ["</svg>"])


if __name__ == "__main__":
    main(__doc__, table, picture)
