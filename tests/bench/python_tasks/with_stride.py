"""The tasks of python_tasks.py as users of stride write them."""

import csv
import math

import stride


def simulate(fmu):
    run = stride.run(fmu, stop=10, step=0.01)
    return run.time, run.signals["relaxation.x"]


def change(fmu):
    with stride.Simulation(fmu, stop=10, set={"relaxation.k": 0.5}) as sim:
        time, x = [sim.time], [sim["relaxation.x"]]
        while not sim.is_over:
            sim["relaxation.u"] = math.sin(sim.time)
            time.append(sim.step(0.01))
            x.append(sim["relaxation.x"])
    return time, x


def feedback(fmu):
    time, x = [0.0], [1.0]
    with stride.Simulation(fmu, stop=10) as sim:
        while not sim.is_over:
            sim["relaxation.u"] = 1.0 if x[-1] < 0.5 else 0.0
            time.append(sim.step(0.01))
            x.append(sim["relaxation.x"])
    return time, x


def couple(fmu):
    with open("pair.ssd", "w") as file:
        file.write(f"""<ssd:SystemStructureDescription version="2.0" name="pair"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription">
  <ssd:System name="pair">
    <ssd:Elements>
      <ssd:Component name="a" source="{fmu}"/>
      <ssd:Component name="b" source="{fmu}"/>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="a" startConnector="x" endElement="b" endConnector="u"/>
    </ssd:Connections>
  </ssd:System>
</ssd:SystemStructureDescription>""")
    run = stride.run("pair.ssd", stop=10, step=0.01)
    return run.time, run.signals["b.x"]


def vary(fmu):
    rows = []
    for i in range(100):
        k = 0.1 + 0.05 * i
        with stride.Simulation(fmu, stop=1, step=0.01, set={"relaxation.k": k}) as sim:
            sim.run()
            rows.append((k, sim["relaxation.x"]))
    with open("table.csv", "w", newline="") as file:
        csv.writer(file).writerows([("k", "x"), *rows])
    return zip(*rows)
