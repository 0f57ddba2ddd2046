"""The report's page in a browser, with data made here: page_test.py PAGE FOLDER

Each test writes its page into FOLDER, and opens it as a user does.
"""

import bisect
import math
import random
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import page_data  # noqa: E402
from browser import Browser  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402

SECOND = 10**12
PIXEL = ("data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAQAAAC1HAwCAAAAC0lEQVR42mNk+M8AAAICAQB"
         "7CYF4AAAAAElFTkSuQmCC")

SQUARE = ("data:image/svg+xml,<svg xmlns='http://www.w3.org/2000/svg' width='600' height='600'>"
          "<rect width='600' height='600' fill='teal'/></svg>")


def message(seconds, component, content, direction="sent", variable="transmit.frame", payload="0102"):
    return {"time": str(round(seconds * SECOND)), "index": 1, "component": component, "variable": variable,
            "direction": direction, "payload": payload, "content": content}


class Run:
    """A made-up run of ten seconds with irregular samples."""

    def __init__(self, rows=2000, seed=1):
        numbers = random.Random(seed)
        self.times = sorted(numbers.sample(range(1, 10 * SECOND), rows - 2) + [0, 10 * SECOND])
        seconds = [time / SECOND for time in self.times]
        self.columns = {
            "tank.level": ([math.sin(t) + numbers.random() / 10 for t in seconds], "m", "Float64"),
            "tank.limit": ([1e-5 if t < 5 else 1.25 for t in seconds], "m", "Float64"),
            "pump.power": ([math.nan if 3 < t < 4 else 40 * t for t in seconds], "W", "Float64"),
            "pump.count": ([int(t) for t in seconds], "", "Int32"),
            "pump.on": ([int(2 < t < 7) for t in seconds], "", "Boolean"),
            "pump.mode": (["off" if t < 2 else "full <power>" for t in seconds], "", "String"),
        }
        self.plots = [("Tank", ["tank.level", "tank.limit"]),
                      ("Pump", ["pump.power", "pump.count", "pump.on", "pump.mode"])]
        self.messages = [message(1, "pump", "start"), message(1, "tank", "start", "received", "receive.frame"),
                         message(1.001, "pump", "faster"), message(6.5, "pump", "a </script> & <b>"),
                         message(9, "tank", "")]
        self.units = [{"name": "tank", "model": "tank", "calls": 12, "steps": 10, "events": 1, "rejections": 2,
                       "rollbacks": 0,
                       "idle": {"skipped": 2.5, "rests": 1, "longest": 2.5},
                       "wall_time": {"initialization": 0.01, "steps": 0.5, "events": 0.1}},
                      {"name": "pump", "model": "minimal", "calls": 3, "steps": 3, "events": 0, "rejections": 0,
                       "rollbacks": 1, "wall_time": {"initialization": 0, "steps": 0.2, "events": 0}}]
        self.run = {"system": "tank <1>", "scenario": "tank.ssd", "start": 0, "stop": 10, "reached": 10, "wall_time": 2,
                    "outcome": "completed", "communication_steps": rows, "units": self.units, "verdicts": [],
                    "checks": []}
        self.films = []

    def data(self):
        columns = [page_data.column(name, values, unit, kind) for name, (values, unit, kind) in self.columns.items()]
        return page_data.report(
            self.times, columns, self.plots, run=self.run, messages=self.messages, films=self.films,
            activity=[page_data.activity("tank", "idle", [(0, 2 * SECOND), (6 * SECOND, 6 * SECOND + SECOND // 2)]),
                      page_data.activity("pump", "idle", [(SECOND, 3 * SECOND)]),
                      page_data.activity("tank", "rejection", [(8 * SECOND, 9 * SECOND)])],
            diagram={"components": [{"name": unit["name"], "model": unit["model"]} for unit in self.units],
                     "connections": [{"from": "tank.level", "to": "pump.level", "kind": "value"},
                                     {"from": "tank.limit", "to": "pump.limit", "kind": "value"},
                                     {"from": "pump.transmit.frame", "to": "tank.receive.frame", "kind": "message"}]})

    def row_at(self, seconds):
        return bisect.bisect_right([time / SECOND for time in self.times], seconds) - 1


class PageTest(unittest.TestCase):
    page = None
    folder = None

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def open(self, data, **options):
        path = self.folder / f"{self.id().rsplit('.', 1)[-1]}.html"
        page_data.write_page(self.page, data, path)
        return self.browser.open(path, **options)

    def open_run(self, run=None, **options):
        return self.open((run or Run()).data(), **options)

    # loading

    def test_loads_without_error_and_asks_for_nothing(self):
        browser = self.open_run()
        self.assertEqual(browser.errors(), [])
        self.assertEqual(browser.requests(), [])
        self.assertEqual(browser.one("h1").text.split("\n")[0].strip(), "tank <1> completed")

    def test_shows_each_signal_once(self):
        browser = self.open_run()
        self.assertEqual(len(browser.all(".pane")), 4)
        self.assertEqual(len(browser.all(".legend .signal")), 6)
        traces = browser.run("return [...document.querySelectorAll('.pane .uplot')].length")
        self.assertEqual(traces, 3)
        self.assertEqual(browser.texts(".legend h3"), ["Tank", "Pump", "Pump", "Pump"])

    def test_data_of_another_format_is_refused_in_words(self):
        browser = self.open({**Run().data(), "format": 2})
        self.assertIn("format 2", browser.one("[role=alert]").text)

    def test_a_broken_array_is_refused_in_words(self):
        data = Run().data()
        data["columns"][0]["values"]["count"] += 1
        self.assertIn("expected", self.open(data).one("[role=alert]").text)

    # values

    def test_values_at_the_cursor_are_those_of_the_row(self):
        run = Run()
        browser = self.open_run(run)
        numbers = random.Random(2)
        samples = [time / SECOND for time in run.times[::97]]
        instants = [0, 10, *(numbers.uniform(0, 10) for _ in range(40)), *samples]
        for seconds in instants:
            row = run.row_at(seconds)
            time_text, values = browser.put_cursor(seconds)
            self.assertEqual(round(float(time_text) * SECOND), run.times[row])
            for name, (column, _, kind) in run.columns.items():
                self.assert_value(values[name], column[row], kind)

    def assert_value(self, text, value, kind):
        if kind == "Boolean":
            self.assertEqual(text, "true" if value else "false")
        elif kind == "String":
            self.assertEqual(text, value)
        elif isinstance(value, float) and math.isnan(value):
            self.assertEqual(text, "nan")
        else:
            self.assertEqual(float(text), value)

    def test_without_a_cursor_there_are_the_last_value_and_the_extremes_of_what_is_shown(self):
        run = Run()
        browser = self.open_run(run)
        _, values = browser.values()
        level = run.columns["tank.level"][0]
        expected = {"last": level[-1], "min": min(level), "max": max(level)}
        found = dict(part.split(" ") for part in values["tank.level"].removesuffix(" m").split(", "))
        self.assertEqual({name: float(text) for name, text in found.items()}, expected)
        self.assertEqual((values["pump.on"], values["pump.mode"]), ("last: false", "last: full <power>"))
        browser.run("stride.view.show(5, 6); stride.view.flush()")
        _, values = browser.values()
        first, last = run.row_at(5), run.row_at(6)
        self.assertEqual(values["pump.count"], f"last {int(run.times[last] / SECOND)}, min "
                         f"{int(run.times[first] / SECOND)}, max {int(run.times[last] / SECOND)}")
        self.assertEqual(values["pump.on"], "last: true")
        self.assertEqual(browser.put_cursor(5)[1]["pump.on"], "true")

    def test_the_mouse_moves_the_cursor_and_a_click_holds_it(self):
        run = Run()
        browser = self.open_run(run)
        y = browser.pane_middle()
        left, right = browser.plot_box()
        browser.move_to(round(left + (right - left) / 4), y)
        seconds = browser.run("return stride.view.cursor")
        self.assertAlmostEqual(seconds, 2.5, delta=10 / (right - left))
        self.assertEqual(round(float(browser.values()[0]) * SECOND), run.times[run.row_at(seconds)])
        browser.click_at(round(left + (right - left) / 2), y)
        browser.move_to(round(left + (right - left) / 8), y)
        self.assertAlmostEqual(browser.run("return stride.view.cursor"), 5, delta=10 / (right - left))
        self.assertTrue(browser.one(".stack-overlay .cursor-line").is_displayed())
        browser.press(Keys.ESCAPE)
        self.assertFalse(browser.one(".stack-overlay .cursor-line").is_displayed())

    # zoom

    def test_dragging_zooms_all_panes(self):
        browser = self.open_run()
        y = browser.pane_middle()
        left, right = browser.plot_box()
        width = right - left
        browser.drag(round(left + 0.2 * width), round(left + 0.4 * width), y)
        start, end = browser.view()
        self.assertAlmostEqual(start, 2, delta=20 / width)
        self.assertAlmostEqual(end, 4, delta=20 / width)
        self.assertIn("to", browser.one(".shown-time").text)
        scales = browser.run("return [...document.querySelectorAll('.ruler')].length")
        self.assertEqual(scales, 1)
        self.assertIn("2.00", browser.one(".shown-time").text)

    def test_keys_move_zoom_and_help(self):
        run = Run()
        browser = self.open_run(run)
        browser.press(Keys.HOME, Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        self.assertEqual(browser.run("return stride.view.row.index"), 2)
        browser.press_with_shift(Keys.ARROW_RIGHT)
        self.assertEqual(browser.run("return stride.view.row.index"), 12)
        browser.press(Keys.END)
        self.assertEqual(browser.values()[0], "10")
        browser.press(Keys.HOME, "n")
        self.assertEqual(browser.run("return stride.view.cursor"), 1)
        browser.press("n", "n")
        self.assertEqual(browser.run("return stride.view.cursor"), 6.5)
        browser.press("p")
        self.assertEqual(browser.run("return stride.view.cursor"), 1.001)
        browser.press("+")
        self.assertAlmostEqual(browser.view()[1] - browser.view()[0], 5)
        browser.press("-", "0")
        self.assertEqual(browser.view(), (0, 10))
        browser.press("?")
        self.assertTrue(browser.one("dialog.help").is_displayed())
        browser.press(Keys.ESCAPE)
        self.assertFalse(browser.one("dialog.help").is_displayed())

    def test_a_spike_of_one_sample_is_drawn(self):
        rows = 200_000
        values = [0.0] * rows
        values[123_457] = 1.0
        data = page_data.report(range(rows), [page_data.column("a.spike", values)], [("A", ["a.spike"])])
        browser = self.open(data)
        found = browser.run("""
            const canvas = document.querySelector('.pane canvas');
            const { width, height } = canvas;
            const pixels = canvas.getContext('2d').getImageData(0, 0, width, height).data;
            const columns = new Set();
            for (let y = 14; y < height / 2; ++y) for (let x = 97; x < width; ++x) {
              const at = 4 * (y * width + x);
              if (pixels[at + 2] - pixels[at] > 80 && pixels[at + 3] > 100) columns.add(x);
            }
            return [[...columns], width]""")
        columns, width = found
        place = 96 + (width - 96) * 123_457 / (rows - 1)
        self.assertTrue(columns, "the spike is not in the picture")
        for x in columns:
            self.assertAlmostEqual(x, place, delta=3)

    def ink(self, curve, begin, end):
        """The least and the greatest height in the first pane at which a curve is, from the top [px], between two shares
        of its width."""
        return self.browser.run("""
            const [curve, begin, end] = arguments;
            const canvas = document.querySelector('.pane canvas');
            const { width, height } = canvas;
            const pixels = canvas.getContext('2d').getImageData(0, 0, width, height).data;
            const hex = getComputedStyle(document.documentElement).getPropertyValue(curve).trim();
            const wanted = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
            const found = [];
            for (let x = Math.round(96 + begin * (width - 96)); x < 96 + end * (width - 96); ++x)
              for (let y = 0; y < height; ++y) {
                const pixel = pixels.slice(4 * (y * width + x), 4 * (y * width + x) + 4);
                const distance = wanted.reduce((sum, part, i) => sum + Math.abs(pixel[i] - part), 0);
                if (distance < 300 && pixel[3] > 100) found.push(y);
              }
            return [Math.min(...found), Math.max(...found)]""", curve, begin, end)

    def test_zero_has_a_place_of_its_own_on_a_logarithmic_axis(self):
        rows = 300
        values = [1e-6 if i < 130 else 0 if i < 200 else 1e-2 for i in range(rows)]
        data = page_data.report(range(0, rows * SECOND, SECOND), [page_data.column("a.load", values, "W", stepped=True)],
                                [("A", ["a.load"])])
        browser = self.open(data)
        self.assertEqual(browser.one(".scale").get_attribute("aria-pressed"), "true")
        small, zero, large = (self.ink("--curve-1", share, share + 0.1) for share in (0.1, 0.5, 0.9))
        self.assertGreater(zero[0] - small[1], 8)
        self.assertGreater(small[0] - large[1], 60)
        browser.one(".scale").click()
        browser.settle()
        self.assertLess(abs(self.ink("--curve-1", 0.5, 0.6)[0] - self.ink("--curve-1", 0.1, 0.2)[0]), 2)

    def test_curves_of_different_sizes_can_have_their_own_scales(self):
        rows = 300
        columns = [page_data.column(f"a.{size:g}", [size * math.sin(i / 10) for i in range(rows)], "W")
                   for size in (1e5, 1e-3)]
        data = page_data.report(range(0, rows * SECOND, SECOND), columns, [("A", ["a.100000", "a.0.001"])])
        browser = self.open(data)
        self.assertEqual(browser.texts(".scale"), ["own scale", "log"])
        top, bottom = self.ink("--curve-2", 0, 1)
        self.assertLess(bottom - top, 5)
        browser.one(".scale").click()
        browser.settle()
        top, bottom = self.ink("--curve-2", 0, 1)
        self.assertGreater(bottom - top, 90)
        self.assertEqual(browser.one(".scale").get_attribute("aria-pressed"), "true")

    # parts

    def test_marks_of_messages_tell_how_many_they_are(self):
        browser = self.open_run()
        browser.wait_for("return document.querySelector('.message-lane .message')")
        lanes = browser.run("return [...document.querySelectorAll('.message-lane')].map((lane) => "
                            "[...lane.querySelectorAll('.message')].map((mark) => mark.textContent))")
        self.assertEqual(lanes, [["start+1", "a </script> & <b>"], ["start", "0102"]])
        cells = browser.run("return [...document.querySelectorAll('.messages tbody tr')].map((row) => "
                            "[...row.cells].slice(0, 4).map((cell) => cell.textContent))")
        self.assertEqual(cells[0], ["1", "pump.transmit.frame", "tank.receive.frame", "start"])
        self.assertEqual(cells[1], ["1.001", "pump.transmit.frame", "–", "faster"])
        self.assertEqual(len(cells), 4)
        browser.one(".filter input").send_keys("pump sent")
        self.assertEqual(len(browser.all(".messages tbody tr")), 3)
        self.assertEqual(browser.one(".count").text, "3 of 4")
        browser.all(".messages tbody tr")[2].click()
        self.assertEqual(browser.run("return stride.view.cursor"), 6.5)

    def test_a_crowd_of_messages_is_bars_that_open_on_zoom(self):
        run = Run()
        run.messages = [message(2 + i / 200, "pump", f"number {i}") for i in range(1000)]
        browser = self.open_run(run)
        browser.wait_for("return document.querySelector('.crowd')")
        self.assertEqual((len(browser.all(".crowd")), len(browser.all(".message"))), (1, 0))
        left, right = browser.plot_box()
        crowd = browser.one(".crowd").rect
        self.assertAlmostEqual(crowd["x"], left + 0.2 * (right - left), delta=5)
        self.assertAlmostEqual(crowd["width"], 0.5 * (right - left), delta=9)
        browser.run("document.querySelector('.crowd').focus()")
        self.assertEqual(browser.texts(".tip div")[0], "1,000 messages from 2 s to 6.995 s: 1,000 sent")
        for _ in range(3):
            crowd = browser.one(".crowd, .message").rect
            browser.click_at(round(crowd["x"] + crowd["width"] / 2), round(crowd["y"] + crowd["height"] / 2))
            if not browser.all(".crowd"):
                break
        self.assertEqual(browser.all(".crowd"), [])
        start, end = browser.view()
        self.assertLess(end - start, 0.2)
        self.assertEqual(len(browser.all(".message")), sum(start <= 2 + i / 200 <= end for i in range(1000)))

    def test_a_mark_tells_all_on_focus(self):
        browser = self.open_run()
        browser.run("document.querySelector('.message').focus()")
        self.assertIn("1.001 s  pump sent transmit.frame: faster", browser.texts(".tip div"))

    def test_a_signal_can_be_hidden(self):
        browser = self.open_run()
        browser.run("document.querySelector('.legend .signal').click()")
        self.assertEqual(browser.one(".legend .signal").get_attribute("aria-pressed"), "false")
        browser.settle()
        self.assertEqual(browser.errors(), [])

    def test_a_failed_check_leads_to_its_instant(self):
        run = Run()
        run.run["checks"] = [
            {"name": "level stays low", "kind": "range", "passed": False, "text": "1.04 m is above 1 m", "time": 7.5,
             "line": 12, "values": [{"signal": "tank.level", "value": 1.04, "unit": "m"}]},
            {"name": "answered", "kind": "answer", "passed": True, "text": "", "time": None, "values": []}]
        browser = self.open_run(run)
        self.assertEqual(browser.one(".banner").text, "1 of 2 failed – first at 7.5 s: level stays low: 1.04 m is above 1 m")
        self.assertIn("tank.level = 1.04 m", browser.one(".verdicts").text)
        browser.press(Keys.ESCAPE, "0")
        left, right = browser.plot_box()
        line = browser.run("return [...document.querySelectorAll('.stack-overlay .failure-line')].map("
                           "(line) => line.getBoundingClientRect().left)")
        self.assertEqual(len(line), 1)
        self.assertAlmostEqual(line[0], left + 0.75 * (right - left), delta=1.5)
        browser.one(".banner .time-link").click()
        self.assertEqual(browser.run("return stride.view.cursor"), 7.5)

    def test_what_failed_says_so_and_opens_where_it_did(self):
        run = Run()
        check = {"kind": "always", "passed": False, "text": "", "values": []}
        run.run["checks"] = [{**check, "name": "late", "time": 9}, {**check, "name": "early", "time": 7.5}]
        browser = self.open_run(run)
        self.assertEqual(browser.one("h1").text, "tank <1> FAILED")
        self.assertEqual(browser.driver.title, "FAILED: tank <1> – stride report")
        self.assertEqual(browser.run("return [stride.view.cursor, stride.view.isHeld]"), [7.5, True])
        self.assertEqual(browser.view(), (6.5, 8.5))
        self.assertEqual(browser.one(".shown-time").text, "6.500 to 8.500 s of 0 to 10 s")
        browser.press(Keys.ESCAPE, "0")
        self.assertEqual(browser.view(), (0, 10))
        self.assertEqual(self.open_run().driver.title, "tank <1> – stride report")

    def test_limits_of_a_signal_without_a_plot_are_seen(self):
        run = Run()
        run.plots = run.plots[:1]
        run.run["checks"] = [
            {"name": "power stays low", "kind": "final", "passed": False, "text": "", "time": 10, "values": [],
             "limits": {"signal": "pump.power", "from": None, "to": None, "max": 300}}]
        browser = self.open_run(run)
        self.assertEqual(browser.texts(".stack-body > .pane h3"), ["Failed checks", "Tank"])
        self.assertEqual(browser.texts(".checked.broken"), ["✗ power stays low"])
        line, _, _ = browser.run(PANE_COLOURS, 0)
        self.assertGreater(line[1], 0.99)

    def test_limits_are_lines_and_violations_shades(self):
        run = Run()
        run.run["checks"] = [
            {"name": "power stays low", "kind": "always", "passed": False, "text": "", "time": 7.5, "values": [],
             "margin": {"value": -100.25, "unit": "W", "at": 10},
             "limits": {"signal": "pump.power", "from": 5, "to": None, "max": 300}},
            {"name": "on", "kind": "never", "passed": False, "text": "", "time": 2, "values": [],
             "margin": {"value": "-inf", "unit": "", "at": 2},
             "limits": {"signal": "pump.on", "from": None, "to": None, "equals": True}}]
        browser = self.open_run(run)
        links = browser.run("return [...document.querySelectorAll('.verdicts td .time-link')].map((a) => a.textContent)")
        self.assertEqual(links, ["-100.3 W", "7.5 s", "-inf", "2 s"])
        browser.run("document.querySelector('.verdicts td .time-link').click()")
        self.assertEqual(browser.run("return stride.view.cursor"), 10)
        browser.press(Keys.ESCAPE, "0")
        line, shade, good = browser.run(PANE_COLOURS, 1)
        self.assertAlmostEqual(line[0], 0.5, delta=0.02)
        self.assertAlmostEqual(line[1], 1, delta=0.02)
        self.assertAlmostEqual(shade[0], 0.75, delta=0.02)
        self.assertGreater(shade[1], 0.98)
        self.assertEqual(good, [])
        self.assertEqual(browser.errors(), [])

    def test_a_failed_run_shows_its_error(self):
        run = Run()
        run.run.update(outcome="failed", error="tank.ssd:7: pump: no <water>", reached=3.5)
        browser = self.open_run(run)
        self.assertEqual(browser.one("h1").text, "tank <1> FAILED at 3.5 s")
        self.assertEqual(browser.run("return stride.view.cursor"), 3.5)
        self.assertIn("The run failed", browser.one(".banner").text)
        self.assertEqual(browser.one(".error").text, "tank.ssd:7: pump: no <water>")

    def test_what_is_missing_is_told(self):
        browser = self.open(page_data.report([], [], []))
        text = browser.one("main").text
        for words in ["No signals were recorded", "No messages were sent", "was not recorded",
                      "Verdicts are not known"]:
            self.assertIn(words, text)
        browser.press(Keys.ARROW_RIGHT, "n", "+", "0")
        self.assertEqual(browser.errors(), [])

    def test_notes_are_shown_once(self):
        browser = self.open({**Run().data(), "notes": ["signals.csv: of each 16 rows"]})
        self.assertEqual(browser.texts(".warning"), ["signals.csv: of each 16 rows"])

    def test_coverage_is_a_map_that_leads_to_the_first_visit(self):
        bins = [{"name": "low", "count": 9, "first": 0.5}, {"name": "high", "count": 0}]
        point = {"name": "level", "kind": "values", "signal": "level", "unit": "m", "at_least": 1, "open": False,
                 "percentage": 50, "bins": bins}
        groups = [{"component": "tank", "percentage": 50, "points": [point]}]
        browser = self.open({**Run().data(), "coverage": {"groups": groups}})
        self.assertEqual(browser.texts(".coverage tbody td.number"), ["1 of 2", "50 %"])
        browser.all(".bin")[0].click()
        self.assertEqual(browser.run("return stride.view.cursor"), 0.5)

    def test_the_film_follows_the_cursor(self):
        run = Run()
        run.films = [{"component": "world", "times": page_data.pack("int64", [i * SECOND for i in range(11)]),
                      "frames": [f"{PIXEL}#{i}" for i in range(11)]}]
        browser = self.open_run(run)
        browser.put_cursor(4.9)
        self.assertTrue(browser.one(".film-picture img").get_attribute("src").endswith("#4"))
        self.assertIn("picture 5 of 11", browser.one(".film-picture").text)
        browser.run("document.querySelector('.film-track').focus()")
        browser.press(Keys.ARROW_RIGHT)
        self.assertTrue(browser.one(".film-picture img").get_attribute("src").endswith("#5"))
        self.assertEqual(browser.one(".film-track").get_attribute("aria-valuenow"), "5")

    def test_the_film_stays_in_sight_and_its_pictures_follow_the_zoom(self):
        run = Run()
        run.films = [{"component": name, "times": page_data.pack("int64", [i * SECOND // 10 for i in range(101)]),
                      "frames": [f"{PIXEL}#{i}" for i in range(101)]} for name in ("world", "other")]
        browser = self.open_run(run, height=600)
        browser.run("window.scrollTo(0, document.querySelector('.stack').offsetTop + 500)")
        browser.settle()
        places = browser.run("return [...document.querySelectorAll('.film-track, .film-picture')].map((part) => "
                             "{ const { top, bottom } = part.getBoundingClientRect(); return [top, bottom]; })")
        self.assertEqual(len(places), 4)
        for top, bottom in places:
            self.assertGreaterEqual(top, 0)
            self.assertLess(bottom, 300)
        pictures = ("return [...document.querySelector('.film-track').children].map((picture) => "
                    "Number(picture.src.split('#')[1]))")
        whole = browser.run(pictures)
        self.assertGreater(whole[-1] - whole[0], 80)
        browser.run("stride.view.show(2, 3); stride.view.flush()")
        browser.settle()
        near = browser.run(pictures)
        self.assertEqual(len(near), len(whole))
        self.assertTrue(all(20 <= picture < 30 for picture in near) and near == sorted(near), near)
        self.assertGreater(near[-1], near[0])

    def test_the_picture_of_a_film_can_be_enlarged(self):
        run = Run()
        run.films = [{"component": "world", "times": page_data.pack("int64", [0]), "frames": [SQUARE]}]
        browser = self.open_run(run)
        height = "return document.querySelector('.film-picture img').clientHeight"
        small = browser.run(height)
        browser.one(".enlarge").click()
        self.assertGreater(browser.run(height), 2 * small)
        browser.one(".enlarge").click()
        self.assertEqual(browser.run(height), small)

    def test_a_film_is_scrubbed_by_dragging(self):
        run = Run()
        run.films = [{"component": "world", "times": page_data.pack("int64", [i * SECOND for i in range(11)]),
                      "frames": [f"{PIXEL}#{i}" for i in range(11)]}]
        browser = self.open_run(run)
        browser.settle()
        y = browser.run("const box = document.querySelector('.film-track').getBoundingClientRect();"
                        "return Math.round((box.top + box.bottom) / 2)")
        left, right = browser.plot_box()
        browser.drag(round(left + 0.1 * (right - left)), round(left + 0.75 * (right - left)), y)
        self.assertEqual(browser.view(), (0, 10))
        self.assertTrue(browser.one(".film-picture img").get_attribute("src").endswith("#7"))

    def test_the_diagram_bundles_connections(self):
        browser = self.open_run()
        self.assertEqual(browser.texts(".block-name"), ["tank", "pump"])
        self.assertEqual(browser.texts(".edge-count"), ["2", "1"])
        self.assertEqual(len(browser.all(".message-edge")), 1)

    def test_costs_are_in_a_table(self):
        browser = self.open_run()
        rows = browser.run("return [...document.querySelectorAll('.costs tbody tr')].map((row) => "
                           "[...row.cells].map((cell) => cell.textContent))")
        self.assertEqual(rows[0], ["tank", "", "0.610", "0.010", "0.500", "0.100", "12", "10", "1", "2", "0", "2.5"])

    def test_what_a_run_was_made_from(self):
        run = Run()
        run.run["provenance"] = {
            "version": "1.2", "date": "2026-11-25T23:59:59Z", "host": "left <b>",
            "commands": [{"text": "stride run 'a tank.ssd'", "words": [], "folder": "/home/a"},
                         {"text": "stride run 'a tank.ssd' --resume", "words": [], "folder": "/home/b"}],
            "swaps": ["tank=mine.fmu"], "values": ["pump.power=3"],
            "sources": [{"what": "the scenario", "path": "a tank.ssd", "sha256": "0123456789abcdef"}]}
        browser = self.open_run(run)
        top = browser.run("const [names, texts] = ['dt', 'dd'].map((tag) => [...document.querySelectorAll('.origin > ' + tag)]"
                          ".map((e) => e.textContent)); return names.map((name, i) => [name, texts[i]])")
        self.assertEqual(top, [
            ["scenario", "tank.ssd"], ["began", "2026-11-25 23:59:59 UTC on left <b>"],
            ["by", "stride run 'a tank.ssd'"], ["and then", "stride run 'a tank.ssd' --resume"],
            ["settings", "0 to 10 s"], ["swapped", "tank=mine.fmu"], ["set", "pump.power=3"],
            ["versions", "stride 1.2, page by stride test"]])
        browser.one(".made-from summary").click()
        text = browser.one(".made-from").text
        for words in ["stride 1.2 began it at 2026-11-25T23:59:59Z on left <b> by", "stride run 'a tank.ssd' in /home/a",
                      "and then stride run 'a tank.ssd' --resume in /home/b", "the scenario", "0123456789ab"]:
            self.assertIn(words, text)
        self.assertEqual(self.open_run().all(".made-from"), [])

    def test_what_units_did_is_in_words_too(self):
        browser = self.open_run()
        self.assertEqual(browser.texts(".lane-summary"), ["idle 2.5 s, 1 rejection", "idle 2 s"])
        idle = browser.run("return [[...stride.report.idle.from], [...stride.report.idle.until]]")
        self.assertEqual(idle, [[1], [2]])

    def test_an_early_return_is_where_the_unit_stopped(self):
        run = Run()
        data = run.data()
        data["activity"] = [page_data.activity("tank", "early return", [(2 * SECOND, 5 * SECOND)]),
                            page_data.activity("tank", "rejection", [(8 * SECOND, 9 * SECOND)])]
        browser = self.open(data)
        browser.run("document.querySelector('.activity-lane').scrollIntoView()")
        browser.settle()
        early, rejected = browser.run("""
            const canvas = document.querySelector('.activity-lane canvas');
            const pixels = canvas.getContext('2d').getImageData(0, 4, canvas.width, 1).data;
            return ['--early-return', '--bad'].map((name) => {
              const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
              const wanted = [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));
              const found = [];
              for (let x = 0; x < canvas.width; ++x)
                if (wanted.every((part, i) => pixels[4 * x + i] === part)) found.push(x / canvas.width);
              return found;
            })""")
        self.assertEqual((len(early), len(rejected)), (1, 1))
        self.assertAlmostEqual(early[0], 0.5, delta=0.003)
        self.assertAlmostEqual(rejected[0], 0.8, delta=0.003)

    # looks

    def test_light_and_dark(self):
        ground = "return getComputedStyle(document.body).backgroundColor"
        browser = self.open_run()
        light = browser.run(ground)
        browser.set_dark(True)
        browser.settle()
        dark = browser.run(ground)
        self.assertNotEqual(light, dark)
        browser.press("d")
        self.assertEqual(browser.run(ground), light)

    def test_long_texts_are_one_line_until_they_have_the_focus(self):
        run = Run()
        long = "it was expected that " * 40
        run.columns["pump.mode"] = ([long] * len(run.times), "", "String")
        run.columns["pump." + "subsystem." * 20 + "mode"] = ([1.5] * len(run.times), "W", "Float64")
        run.plots[1][1].append("pump." + "subsystem." * 20 + "mode")
        run.run["checks"] = [{"name": long, "kind": "always", "passed": passed, "text": long, "time": 7.5 if i else None,
                              "values": [{"signal": "pump.mode", "value": long}]}
                             for i, passed in enumerate([True, False])]
        for width in (1400, 480):
            browser = self.open_run(run, width=width)
            self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), width)
            self.assertEqual(browser.run("return document.querySelector('.verdicts').clientWidth"),
                             browser.run("return document.querySelector('header').clientWidth"))
            heights = browser.run("return ['.banner', '.because > div', '.verdicts th[scope=row]', '.value', '.signal'].map("
                                  "(part) => Math.max(...[...document.querySelectorAll(part)].map((e) => e.clientHeight)))")
            self.assertLess(max(heights), 60, heights)
        because = browser.one(".because > div")
        self.assertEqual(because.get_attribute("title").strip(), long.strip())
        because.click()
        self.assertGreater(because.size["height"], 100)

    def test_texts_have_enough_contrast(self):
        for dark in (False, True):
            browser = self.open_run(dark=dark)
            ratios = browser.run(CONTRAST)
            for name, ratio in ratios.items():
                least = 3 if name.startswith("--curve") else 4.5
                self.assertGreaterEqual(ratio, least, f"{name} {'dark' if dark else 'light'}")

    def test_paper_is_light_and_complete(self):
        browser = self.open_run(dark=True, height=300)
        browser.run("window.printed = []; window.addEventListener('beforeprint', () => printed.push("
                    "document.documentElement.dataset.theme, document.querySelectorAll('.pane .uplot').length))")
        browser.driver.execute_cdp_cmd("Page.printToPDF", {})
        self.assertEqual(browser.run("return printed"), ["light", 3])
        self.assertEqual(browser.run("return document.documentElement.dataset.theme"), "dark")

    def test_a_narrow_window_needs_no_scrolling_aside(self):
        browser = self.open_run(width=480)
        self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), 480)

    # speed

    def test_a_million_samples_zoom_like_ten_thousand(self):
        small, large = (self.redraw_time(rows) for rows in (10_000, 1_000_000))
        print(f"redraw of a zoom, ten columns: {small:.1f} ms with 10^4 samples, {large:.1f} ms with 10^6")
        self.assertLess(large / small, 5)

    def redraw_time(self, rows):
        """The median of the time [ms] that drawing a view takes, of views in which each pixel has several samples."""
        values = [math.sin(i / 50) + (i * 7919 % 100) / 500 for i in range(rows)]
        column = page_data.column("a.b", values, "V")
        columns = [{**column, "name": f"a.b{i}"} for i in range(10)]
        plots = [(f"Pane {i}", [f"a.b{2 * i}", f"a.b{2 * i + 1}"]) for i in range(5)]
        self.open(page_data.report(range(0, rows * 10**6, 10**6), columns, plots))
        self.browser.settle()
        return self.browser.driver.execute_async_script("""
            const done = arguments[0];
            const { view } = stride;
            const times = [];
            const measure = async (i) => {
              const span = (view.whole.until - view.whole.from) / 1.02 ** i;
              const start = performance.now();
              view.show(view.whole.until / 3, view.whole.until / 3 + span);
              view.flush();
              await new Promise((resolve) => setTimeout(resolve));  // uPlot draws when all else is done
              times.push(performance.now() - start);
            };
            (async () => {
              for (let i = 0; i < 60; ++i) await measure(i);
              done(times.sort((a, b) => a - b)[30]);
            })();""")


# The shares of the width between which a pane has pixels of the limits' lines and of the shades behind them.
PANE_COLOURS = """
    const canvas = document.querySelectorAll('.pane canvas')[arguments[0]];
    const { width, height } = canvas;
    const pixels = canvas.getContext('2d').getImageData(0, 0, width, height).data;
    const hex = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
    const rgb = (name) => [1, 3, 5].map((i) => parseInt(hex(name).slice(i, i + 2), 16));
    const between = (name) => {
      const wanted = rgb(name);
      const found = [];
      for (let y = 0; y < height; ++y) for (let x = 97; x < width; ++x) {
        const at = 4 * (y * width + x);
        if (wanted.every((part, i) => Math.abs(pixels[at + i] - part) < 3)) found.push((x - 96) / (width - 96));
      }
      return found.length === 0 ? [] : [Math.min(...found), Math.max(...found)];
    };
    return [between('--bad'), between('--bad-ground'), between('--good')];
"""

CONTRAST = """
    const style = getComputedStyle(document.documentElement);
    const luminance = (name) => {
      const hex = style.getPropertyValue(name).trim().slice(1);
      const [r, g, b] = [0, 2, 4].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255)
        .map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const ratio = (one, other) => {
      const [high, low] = [luminance(one), luminance(other)].sort((a, b) => b - a);
      return (high + 0.05) / (low + 0.05);
    };
    const names = ['--text', '--quiet-text', '--link', '--good', '--bad', '--open',
      ...[1, 2, 3, 4, 5, 6].map((i) => `--curve-${i}`)];
    return Object.fromEntries(names.map((name) => [name, ratio(name, '--page')]));
"""


if __name__ == "__main__":
    PageTest.page, PageTest.folder = (Path(argument) for argument in sys.argv[1:3])
    PageTest.folder.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
