"""Reports of real runs in a browser: runs_test.py STRIDE SCENARIOS FOLDER

What the page shows at the cursor is compared with signals.csv, character by character; messages with events.csv.
"""

import csv
import os
import random
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from browser import Browser  # noqa: E402

SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="2.0" name="million"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="million"><ssd:Elements>{components}</ssd:Elements>
    <ssd:Connections>{connections}</ssd:Connections></ssd:System>
  <ssd:DefaultExperiment startTime="0" stopTime="1"/>
  <ssd:Annotations><ssc:Annotation type="org.stride">
    <stride:Scenario xmlns:stride="urn:org.stride:scenario:1">
      <stride:Step size="1e-6"/><stride:Results trace="none"/>
    </stride:Scenario>
  </ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>
"""
FILTERS = 4


def million_samples(folder):
    """A chain of filters in steps of a microsecond."""
    components = "".join(f'<ssd:Component name="f{i}" source="minimal.fmu"/>' for i in range(FILTERS))
    connections = "".join(
        f'<ssd:Connection startElement="f{i}" startConnector="y" endElement="f{i + 1}" endConnector="u"/>'
        for i in range(FILTERS - 1))
    path = folder / "million.ssd"
    path.write_text(SCENARIO.format(components=components, connections=connections), encoding="utf-8")
    return path


class RunsTest(unittest.TestCase):
    program = scenarios = folder = None

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(webgl=True)

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def run_scenario(self, scenario, *options):
        results = self.folder / scenario.stem
        subprocess.run([self.program, "run", scenario, "--out", results, *options], check=True, capture_output=True)
        return results

    def open_report(self, results):
        browser = self.browser.open(results / "report.html")
        self.assertEqual(browser.errors(), [])
        self.assertEqual(browser.requests(), [])
        return browser

    def assert_values(self, browser, results, count):
        """Compares the values at many rows, and between them."""
        with open(results / "signals.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        names = [name.split(" [")[0] for name in rows.pop(0)[1:]]
        browser.run("for (const details of document.querySelectorAll('details.others')) details.open = true")
        numbers = random.Random(3)
        for index in [0, len(rows) - 2, *(numbers.randrange(len(rows) - 1) for _ in range(count))]:
            row, after = rows[index], rows[index + 1]
            for seconds in (float(row[0]), (float(row[0]) + float(after[0])) / 2):
                time_text, values = browser.put_cursor(seconds)
                self.assertEqual([time_text, *(values[name] for name in names)], row)

    def test_the_flagship(self):
        results = self.run_scenario(self.scenarios / "nfc_approach" / "nfc_approach.ssd")
        browser = self.open_report(results)
        with open(results / "events.csv", newline="", encoding="utf-8") as file:
            messages = list(csv.DictReader(file))
        ends = browser.run("return [...document.querySelectorAll('.messages tbody tr')].map((row) => "
                           "[...row.querySelectorAll('.end')].map((cell) => cell.textContent))")
        sent = [f"{row['component']}.{row['variable']}" for row in messages if row["direction"] == "sent"]
        self.assertEqual([sender for sender, _ in ends], sent)
        received = [f"{row['component']}.{row['variable']}" for row in messages if row["direction"] == "received"]
        self.assertEqual([receiver for _, text in ends for receiver in text.split(", ") if receiver != "–"], received)
        marked = browser.run("return [...document.querySelectorAll('.message')].map((mark) => "
                             "Number(mark.querySelector('.message-more')?.textContent ?? 0) + 1)")
        self.assertEqual(sum(marked), len(messages))
        self.assertRegex(browser.one(".banner.good").text, "^All [0-9]+ passed$")
        self.assertEqual(browser.texts(".block-name"),
                         ["world", "environment", "channel", "reader", "sensor", "ground_truth"])
        self.assert_values(browser, results, 100)

    def test_two_runs_over_each_other(self):
        scenario = self.scenarios / "nfc_approach" / "nfc_approach.ssd"
        options = [["--out", "before"], ["--out", "after", "--set", "sensor.power.capacitance=150e-6"]]
        for each in options:
            subprocess.run([self.program, "run", scenario, "--no-report", *each], capture_output=True,
                           check=True, cwd=self.folder)
        compared = subprocess.run([self.program, "compare", "before", "after", "--html", "c.html"], cwd=self.folder,
                                  capture_output=True)
        self.assertEqual(compared.returncode, 1)
        browser = self.browser.open(self.folder / "c.html")
        self.assertEqual(browser.errors() + browser.requests(), [])
        self.assertEqual(browser.one("h1").text, "before and after DIFFER")
        self.assertRegex(browser.one(".banner.bad").text, "^[0-9]+ things differ – first at 0 s: ")
        self.assertIn("sensor.power.capacitance=150e-6", browser.one("table.inputs").text)
        led = "[...document.querySelectorAll('.row.pane')].find((row) => row.textContent.includes('sensor.led'))"
        browser.put_cursor(14.7)
        self.assertEqual(browser.run(f"return [...{led}.querySelectorAll('.value')].map((each) => each.textContent)"),
                         ["true", "false"])  # the smaller capacitor is empty before
        browser.run("[...document.querySelectorAll('table.differences button')]"
                    ".find((each) => each.textContent === 'sensor.led').click()")
        browser.settle()
        first = browser.run("return stride.view.cursor")
        self.assertTrue(14.2 < first < 14.7, first)
        self.assertTrue(browser.run(f"const box = {led}.getBoundingClientRect();"
                                    "return box.top >= 0 && box.bottom <= innerHeight"))

    def test_the_world_of_the_flagship_is_where_the_signals_say(self):
        results = self.run_scenario(self.scenarios / "nfc_approach" / "nfc_approach.ssd", "--scene",
                                    "--signals", "world.site.*", "--signals", "sensor.led")
        with open(results / "signals.csv", newline="", encoding="utf-8") as file:
            rows = [{name.split(" [")[0]: value for name, value in row.items()} for row in csv.DictReader(file)]
        browser = self.open_report(results)
        browser.wait_for("return document.querySelector('.world-picture').ariaBusy === 'false'")
        samples = [row for row in rows if row["time"] in {str(3 * i) for i in range(11)}]
        self.assertEqual(len(samples), 11)
        for row in samples:  # between them the motion is interpolated
            browser.run("stride.view.holdCursor(Number(arguments[0])); stride.view.flush()", row["time"])
            for site in ("tag_coil", "reader_coil"):
                place = browser.run("return stride.stack.worlds[0].world.positionOf(arguments[0])", site)
                for axis, value in zip("xyz", place):
                    self.assertAlmostEqual(value, float(row[f"world.site.{site}.position.{axis}"]), delta=1e-5)
        switched = [(before, row) for before, row in zip(rows, rows[1:]) if before["sensor.led"] != row["sensor.led"]]
        self.assertGreaterEqual(len(switched), 2)
        for before, row in switched:
            lit = {entry["sensor.led"]: self.lit_pixels(browser, entry["time"]) for entry in (before, row)}
            self.assertEqual(lit["false"], 0, row["time"])
            self.assertGreater(lit["true"], 0, row["time"])

    @staticmethod
    def lit_pixels(browser, seconds):
        """The pixels of the world's picture that are as red as the LED where it shines."""
        return browser.run("""
          const { world } = stride.stack.worlds[0];
          stride.view.holdCursor(Number(arguments[0])); stride.view.flush();
          world.draw();
          const copy = document.createElement("canvas");
          Object.assign(copy, { width: world.canvas.width, height: world.canvas.height });
          const context = copy.getContext("2d");
          context.drawImage(world.canvas, 0, 0);
          const { data } = context.getImageData(0, 0, copy.width, copy.height);
          let count = 0;
          for (let i = 0; i < data.length; i += 4) count += data[i] > 200 && data[i + 1] < 80 && data[i + 2] < 80;
          return count;""", seconds)

    def test_a_million_samples(self):
        scenario = million_samples(self.folder)
        results = self.run_scenario(scenario, "--set", "f0.u=1", "--set", "f0.time_constant=1e-3")
        browser = self.open_report(results)
        self.assertEqual(browser.run("return stride.report.times.length"), 1_000_001)
        self.assertEqual(len(browser.all(".legend .signal")), FILTERS)
        self.assert_values(browser, results, 30)
        y = browser.pane_middle()
        left, right = browser.plot_box()
        for _ in range(3):
            browser.drag(round(left + 0.4 * (right - left)), round(left + 0.6 * (right - left)), y)
        self.assertAlmostEqual(browser.view()[1] - browser.view()[0], 0.2**3, delta=0.002)


if __name__ == "__main__":
    RunsTest.program = sys.argv[1]
    RunsTest.scenarios, RunsTest.folder = (Path(argument) for argument in sys.argv[2:4])
    os.makedirs(RunsTest.folder, exist_ok=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
