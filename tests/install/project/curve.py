def flow(pressure):
    return 1e-3 * max(0.0, pressure) ** 0.5
