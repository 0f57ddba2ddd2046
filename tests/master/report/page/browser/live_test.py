"""The page of a run that goes on, in a browser: live_test.py STRIDE FOLDER

The run is as slow as the wall clock, and has some seconds.
"""

import os
import re
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from browser import PATIENCE, Browser  # noqa: E402

SCENARIO = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription version="2.0" name="slow"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="slow"><ssd:Elements>
    <ssd:Component name="first" source="minimal.fmu"/><ssd:Component name="second" source="minimal.fmu"/>
  </ssd:Elements><ssd:Connections>
    <ssd:Connection startElement="first" startConnector="y" endElement="second" endConnector="u"/>
  </ssd:Connections></ssd:System>
  <ssd:DefaultExperiment startTime="0" stopTime="{stop}"/>
  <ssd:Annotations><ssc:Annotation type="org.stride">
    <stride:Scenario xmlns:stride="urn:org.stride:scenario:1"><stride:Step size="1e-2"/></stride:Scenario>
  </ssc:Annotation></ssd:Annotations>
</ssd:SystemStructureDescription>
"""

SAMPLES = "stride.report.times.length"
CONTENT = """const copy = document.getElementById('report').cloneNode(true);
copy.querySelector('.live')?.remove();
return [...copy.querySelectorAll('h1, h2, h3, p, dt, dd, td, th, li, summary')].map((each) => each.textContent);"""


class Run:
    """A slow run with its page."""

    def __init__(self, folder, stop, name):
        scenario = folder / f"{name}.ssd"
        scenario.write_text(SCENARIO.format(stop=stop), encoding="utf-8")
        self.results = folder / name
        self.errors = folder / f"{name}.log"
        with open(self.errors, "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                [LiveTest.program, "run", "--live", scenario, "--out", self.results, "--quiet", "--realtime", "1",
                 "--set", "first.u=1", "--set", "first.time_constant=0.5"], stderr=log)

    def end(self):
        self.process.kill()
        self.process.wait()

    def address(self):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            found = re.search(r"http://127\.0\.0\.1:\d+/\w+/", self.errors.read_text(encoding="utf-8"))
            if found:
                return found[0]
            time.sleep(0.01)
        raise TimeoutError("the run has no page")


class LiveTest(unittest.TestCase):
    program = folder = None

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def open(self, run):
        self.addCleanup(run.end)
        self.browser.open_address(run.address())
        self.assertEqual(self.browser.errors(), [])
        return self.browser

    def test_values_arrive_and_the_end_is_that_of_the_report(self):
        run = Run(self.folder, 6, "seen")
        browser = self.open(run)
        first = browser.run(f"window.column = stride.report.columns.get('first.y'); return {SAMPLES}")
        self.assertEqual(browser.one(".live strong").text, "live")
        browser.wait_for(f"return {SAMPLES} > arguments[0]", first)
        self.assertTrue(browser.run("return stride.view.isWhole && stride.view.until === stride.report.seconds.at(-1)"))
        self.assertTrue(browser.run("return column === stride.report.columns.get('first.y')"
                                    f" && column.values.length === {SAMPLES}"))
        self.assertIn("reached", browser.one(".live-text").text)
        browser.picture(self.folder / "live.png")
        # what the reader does with it stays
        browser.one("button.signal[title='Hide or show first.y']").click()
        browser.run("document.querySelector('.made-from details, details.made-from').open = true;"
                    "stride.view.show(0.125, 0.375); stride.view.holdCursor(0.25); stride.view.flush()")
        before = browser.run(f"return {SAMPLES}")
        browser.wait_for(f"return {SAMPLES} > arguments[0]", before)
        self.assert_kept(browser)
        browser.wait_for("return document.querySelector('.live strong').textContent === 'ended'")
        self.assertEqual(run.process.wait(), 0)
        self.assert_kept(browser)
        self.assertEqual(browser.run(f"return {SAMPLES}"), 601)
        self.assertEqual(browser.errors(), [])
        browser.run("stride.view.releaseCursor(); stride.view.showWhole(); stride.view.flush()")
        browser.picture(self.folder / "ended.png")
        last = browser.run(CONTENT)
        browser.open(run.results / "report.html")
        self.assertEqual(browser.run(CONTENT), last)

    def assert_kept(self, browser):
        self.assertEqual(browser.view(), (0.125, 0.375))
        self.assertEqual(browser.run("return [stride.view.cursor, stride.view.isHeld]"), [0.25, True])
        self.assertEqual(browser.one("button.signal[title='Hide or show first.y']").get_attribute("aria-pressed"),
                         "false")
        self.assertTrue(browser.run("return document.querySelector('.made-from details, details.made-from').open"))
        self.assertEqual(browser.put_cursor(0.25)[0], "0.25")

    def test_a_page_that_is_paused_and_a_run_that_is_killed(self):
        run = Run(self.folder, 600, "killed")
        browser = self.open(run)
        browser.wait_for(f"return {SAMPLES} > 1")
        browser.one(".live button").click()
        self.assertEqual(browser.one(".live strong").text, "paused")
        browser.wait_for("return stride.follower.reading === undefined || stride.follower.reading.then(() => true)")
        before = browser.run(f"return {SAMPLES}")
        time.sleep(2.5)  # some updates
        self.assertEqual(browser.run(f"return {SAMPLES}"), before)
        browser.one(".live button").click()
        browser.wait_for(f"return {SAMPLES} > arguments[0]", before)
        self.assertIn("the run goes on", browser.one(".banner").text)
        run.end()
        browser.wait_for("return document.querySelector('.live strong').textContent === 'connection lost'")
        self.assertEqual(browser.one(".banner").text, "Not judged: the run was killed, or goes on")
        self.assertNotIn("running", browser.one("header").text)
        self.assertGreater(browser.run(f"return {SAMPLES}"), 1)


if __name__ == "__main__":
    LiveTest.program, LiveTest.folder = sys.argv[1], Path(sys.argv[2])
    os.makedirs(LiveTest.folder, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
