"""Worlds in 3D on the report's page: world_test.py PAGE WORLD_SCRIPT FOLDER

WebGL is drawn in software here. The pixels of a canvas are read in the task that has drawn it.
"""

import json
import math
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import page_data  # noqa: E402
import world_file  # noqa: E402
from browser import Browser  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402
from selenium.webdriver.support.ui import Select  # noqa: E402

SECOND = 10**12
SQUARE = ("data:image/svg+xml,<svg xmlns='http://www.w3.org/2000/svg' width='400' height='300'>"
          "<rect width='400' height='300' fill='teal'/></svg>")
WORLD = "stride.stack.worlds[0].world"
# The pixels of a kind on a canvas: their number, and the mean of their places [px of the canvas].
COUNT = """
  const [canvas, isOfKind] = arguments;
  const copy = document.createElement("canvas");
  Object.assign(copy, { width: canvas.width, height: canvas.height });
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0);
  const { data } = context.getImageData(0, 0, copy.width, copy.height);
  const test = new Function("r", "g", "b", `return ${isOfKind}`);
  let count = 0, x = 0, y = 0;
  for (let i = 0; i < data.length; i += 4) {
    if (!test(data[i], data[i + 1], data[i + 2])) continue;
    ++count;
    x += (i / 4) % copy.width;
    y += Math.floor(i / 4 / copy.width);
  }
  return { count, x: x / count, y: y / count, width: copy.width, height: copy.height };
"""
RED = "r > 120 && g < 90 && b < 90"
LIT = "g > 200 && r < 80 && b < 80"
MARK = "r > 180 && g > 50 && g < 110 && b < 40"
BLUE = "b > 200 && r < 90 && g < 160"


def run_of(rows=101, **more):
    times = [i * 10 * SECOND // (rows - 1) for i in range(rows)]
    run = {"system": "slide", "start": 0, "stop": 10, "reached": 10, "wall_time": 1, "outcome": "completed",
           "units": [], "verdicts": [], "checks": [], **more}
    return page_data.report(times, [page_data.column("a.x", [i / 10 for i in range(rows)], "m")],
                            [("Place", ["a.x"])], run=run)


def tearDownModule():
    for browser in WorldPage.browsers.values():
        browser.close()


class WorldPage(unittest.TestCase):
    """What all tests need: a browser, and pages with the sample of world_file.py."""

    page = script = folder = None
    has_webgl = True
    browsers = {}

    @classmethod
    def setUpClass(cls):
        if cls.has_webgl not in cls.browsers:
            cls.browsers[cls.has_webgl] = Browser(webgl=cls.has_webgl)
        cls.browser = cls.browsers[cls.has_webgl]

    @classmethod
    def open_world(cls, name, *, world=None, film=False, data=None, **options):
        data = data or run_of()
        data["worlds"] = [{"component": "world", "file": page_data.pack("uint8", world or world_file.sample())}]
        data["world_script"] = json.loads(cls.script.read_text(encoding="utf-8"))
        if film:
            data["films"] = [{"component": "world", "times": page_data.pack("int64", [0]), "frames": [SQUARE]}]
        cls.open_data(name, data, **options)
        cls.browser.wait_for("return document.querySelector('.world-picture').ariaBusy === 'false'")
        cls.browser.settle()

    @classmethod
    def open_data(cls, name, data, **options):
        path = cls.folder / f"{name}.html"
        page_data.write_page(cls.page, data, path)
        cls.browser.open(path, **options)

    def put_cursor(self, seconds):
        self.browser.run("stride.view.holdCursor(arguments[0]); stride.view.flush()", seconds)

    def count(self, kind):
        """The pixels of the world's canvas, drawn now."""
        return self.browser.run(f"{WORLD}.draw(); return (function () {{{COUNT}}})({WORLD}.canvas, arguments[0])", kind)


class WorldTest(WorldPage):
    """One page, which each test finds as it opened."""

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.open_world("world")

    def setUp(self):
        self.browser.run("""stride.view.showWhole(); stride.view.releaseCursor(); stride.view.flush();
          document.activeElement.blur();
          for (const button of document.querySelectorAll('.world-controls [aria-pressed=true]')) button.click();""")
        self.browser.run(f"{WORLD}.eye.reset()")

    def wait_for_strip(self):
        """Until the pictures along the axis are drawn, for which the page waits a little: timers are called in turn."""
        self.browser.settle()
        self.browser.driver.execute_async_script("setTimeout(arguments[0], 500)")
        self.browser.settle()

    def choose(self, label, text):
        Select(self.browser.one(f"select[aria-label={label}]")).select_by_visible_text(text)
        self.browser.settle()

    def chosen(self, label):
        return Select(self.browser.one(f"select[aria-label={label}]")).first_selected_option.text

    # what is drawn

    def test_the_cursor_moves_the_body_in_the_picture(self):
        for seconds in (1, 5, 9):
            self.put_cursor(seconds)
            found = self.count(RED)
            # seen from 2 m above, the top of the block 0.2 m above the floor, and a little of its side
            scale = found["height"] / 2 / math.tan(0.4) / 1.8
            expected = found["width"] / 2 + (seconds / 10 - 0.5) * scale
            self.assertAlmostEqual(found["x"], expected, delta=4)
            self.assertAlmostEqual(found["y"], found["height"] / 2, delta=2)

    def test_positions_are_exact_at_any_instant(self):
        browser = self.browser
        for seconds in (0, 0.1, 1 / 3, 2, math.pi, 4.999999, 6.5, 7.77, 9.99, 10):
            self.put_cursor(seconds)
            place = browser.run(f"return {WORLD}.positionOf('block')")
            for value, expected in zip(place, (seconds / 10 - 0.5, 0, 0.1)):
                self.assertAlmostEqual(value, expected, delta=1e-6)

    def test_a_lamp_is_switched_at_its_very_instant(self):
        for seconds, is_lit in ((3.999, False), (4, True), (5.999, True), (6, False)):
            self.put_cursor(seconds)
            self.assertEqual(self.count(LIT)["count"] > 0, is_lit, seconds)

    def test_without_a_cursor_it_is_the_begin_of_what_is_shown_as_in_a_film(self):
        browser = self.browser
        browser.run("stride.view.show(4, 6); stride.view.flush()")
        self.assertAlmostEqual(browser.run(f"return {WORLD}.posed"), 4)
        self.assertIn("world at 4.000 s", browser.one(".world-picture figcaption").text)

    def test_nothing_is_drawn_while_nothing_changes(self):
        browser = self.browser
        self.wait_for_strip()
        browser.run(f"window.drawn = 0; {WORLD}.addEventListener('drawn', () => ++window.drawn)")
        for _ in range(5):
            browser.settle()
        self.assertEqual(browser.run("return window.drawn"), 0)
        browser.run("stride.view.holdCursor(3); stride.view.holdCursor(4)")
        browser.settle()
        browser.settle()
        self.assertEqual(browser.run("return window.drawn"), 1)

    def test_pictures_along_the_axis_are_of_their_instants(self):
        browser = self.browser
        self.wait_for_strip()
        shares = browser.run(f"""return [...document.querySelectorAll('.film-track canvas')].map((canvas) => {{
          const found = (function () {{{COUNT}}})(canvas, arguments[0]); return found.x / found.width; }})""", RED)
        self.assertGreater(len(shares), 3)
        self.assertEqual(shares, sorted(shares))
        self.assertLess(shares[0], 0.45)
        self.assertGreater(shares[-1], 0.55)
        self.assertAlmostEqual(browser.run(f"return {WORLD}.positionOf('block')[0]"), -0.5, delta=1e-6)

    # what is chosen

    def test_a_camera_of_the_file_or_a_free_one(self):
        browser = self.browser
        self.put_cursor(5)
        self.assertEqual(self.chosen("camera"), "film")
        above = self.count(RED)
        self.choose("camera", "side")
        self.assertGreater(self.count(RED)["y"], above["y"] + 5)
        self.choose("camera", "film")
        self.assertEqual(self.count(RED), above)
        self.choose("camera", "free")
        self.assertEqual(self.count(RED), above)
        browser.run(f"{WORLD}.canvas.scrollIntoView({{block: 'center'}})")
        left, top = browser.run(f"const box = {WORLD}.canvas.getBoundingClientRect(); return [box.left, box.top]")
        self.choose("camera", "film")
        browser.drag(round(left + 40), round(left + 90), round(top + 30))
        self.assertEqual(self.chosen("camera"), "free")
        self.assertNotEqual(self.count(RED), above)
        self.assertEqual(browser.run("return stride.view.cursor"), 5)

    def test_the_view_follows_a_body(self):
        self.put_cursor(1)
        self.choose("follow", "block")
        before = self.count(RED)
        self.put_cursor(9)
        after = self.count(RED)
        for name in ("x", "y"):
            self.assertAlmostEqual(after[name], before[name], delta=1)
        self.choose("follow", "nothing")
        self.put_cursor(5)
        self.assertGreater(abs(self.count(RED)["x"] - before["x"]), 10)

    def test_contacts_are_shown_on_request_while_they_last(self):
        browser = self.browser
        self.put_cursor(5)
        self.assertEqual(self.count(MARK)["count"], 0)
        self.assertIn("1 contact", browser.one(".world-picture figcaption").text)
        button = next(button for button in browser.all(".world-controls button") if button.text == "contacts")
        button.click()
        self.assertGreater(self.count(MARK)["count"], 20)
        self.put_cursor(1)
        self.assertEqual(self.count(MARK)["count"], 0)
        self.assertIn("0 contacts", browser.one(".world-picture figcaption").text)

    def test_frames_of_sites_are_shown_on_request(self):
        browser = self.browser
        self.choose("camera", "side")
        self.assertEqual(self.count(BLUE)["count"], 0)
        next(button for button in browser.all(".world-controls button") if button.text == "frames").click()
        self.assertGreater(self.count(BLUE)["count"], 10)

    def test_the_pointer_names_a_body(self):
        browser = self.browser
        self.put_cursor(5)
        box = browser.run(f"const box = {WORLD}.canvas.getBoundingClientRect();"
                          "return [box.left + box.width / 2, box.top + box.height / 2]")
        browser.move_to(*(round(value) + 8 for value in box))
        browser.settle()
        self.assertEqual(browser.one(".tip").text, "block\ngeom block_box")
        self.assertEqual(browser.run("return stride.view.cursor"), 5)

    def test_arrow_keys_turn_the_world_and_leave_the_cursor(self):
        browser = self.browser
        self.put_cursor(5)
        before = self.count(RED)
        browser.run(f"{WORLD}.canvas.focus()")
        browser.press(Keys.ARROW_LEFT, Keys.ARROW_DOWN)
        self.assertNotEqual(self.count(RED), before)
        self.assertEqual(browser.run("return stride.view.cursor"), 5)
        browser.press(Keys.HOME)
        self.assertEqual(self.count(RED), before)
        browser.press("n", Keys.ESCAPE)
        self.assertIsNone(browser.run("return stride.view.cursor"))

    def test_the_wheel_scrolls_the_page_until_the_world_was_touched(self):
        browser = self.browser
        wheel = (f"const event = new WheelEvent('wheel', {{deltaY: 100, bubbles: true, cancelable: true}});"
                 f"{WORLD}.canvas.dispatchEvent(event); return event.defaultPrevented")
        self.assertFalse(browser.run(wheel))
        browser.run(f"{WORLD}.canvas.focus()")
        self.assertTrue(browser.run(wheel))

    def test_it_is_enlarged_and_fills_the_width(self):
        browser = self.browser
        size = f"return [{WORLD}.canvas.clientWidth, {WORLD}.canvas.clientHeight, {WORLD}.canvas.width]"
        small = browser.run(size)
        browser.one(".world-larger").click()
        browser.settle()
        large = browser.run(size)
        self.assertGreater(large[0], 1200)
        self.assertGreater(large[1], small[1] * 2)
        self.assertEqual(large[0], large[2])
        browser.one(".world-larger").click()
        browser.settle()
        self.assertEqual(browser.run(size), small)

    # playing

    def test_playing_moves_the_cursor_to_the_end_of_what_is_shown(self):
        browser = self.browser
        Select(browser.one("select[aria-label=Speed]")).select_by_visible_text("100×")
        browser.run("stride.view.show(2, 8); stride.view.flush(); document.activeElement.blur()")
        browser.press(" ")
        browser.wait_for("return stride.player.isPlaying === false")
        browser.settle()
        self.assertEqual(browser.run("return stride.view.cursor"), 8)
        self.assertAlmostEqual(browser.run(f"return {WORLD}.positionOf('block')[0]"), 0.3, delta=1e-6)
        Select(browser.one("select[aria-label=Speed]")).select_by_visible_text("0.01×")
        browser.one(".play").click()
        browser.wait_for("return stride.view.cursor > 2")
        self.assertEqual(browser.one(".play").get_attribute("aria-label"), "Pause (Space)")
        browser.one(".play").click()
        self.assertLess(browser.run("return stride.view.cursor"), 8)
        self.assertFalse(browser.run("return stride.player.isPlaying"))

    def test_paper_has_a_picture_of_it(self):
        browser = self.browser
        browser.run("window.dispatchEvent(new Event('beforeprint'))")
        still = browser.run(f"return (function () {{{COUNT}}})(document.querySelector('.world-still'), arguments[0])", RED)
        browser.run("window.dispatchEvent(new Event('afterprint'))")
        self.assertGreater(still["count"], 50)


class PagesTest(WorldPage):
    """A page for each test."""

    def test_the_world_is_on_the_page_and_asks_for_nothing(self):
        self.open_world("alone")
        self.assertEqual(self.browser.errors(), [])
        self.assertEqual(self.browser.requests(), [])
        shot = self.browser.driver.get_screenshot_as_base64()
        self.browser.driver.execute_async_script(f"""
          const [url, done] = arguments;
          const image = new Image();
          image.onload = () => {{
            const canvas = document.createElement("canvas");
            Object.assign(canvas, {{ width: image.width, height: image.height }});
            canvas.getContext("2d").drawImage(image, 0, 0);
            const box = {WORLD}.canvas.getBoundingClientRect();
            const part = document.createElement("canvas");
            Object.assign(part, {{ width: box.width, height: box.height }});
            part.getContext("2d").drawImage(canvas, -box.left, -box.top);
            window.part = part;
            done();
          }};
          image.src = url;""", f"data:image/png;base64,{shot}")
        found = self.browser.run(f"return (function () {{{COUNT}}})(window.part, arguments[0])", RED)
        self.assertGreater(found["count"], 50)
        self.assertLess(found["count"], found["width"] * found["height"] / 10)

    def test_time_0_of_the_file_is_the_start_of_the_run(self):
        self.open_world("later", world=world_file.sample("2.5"))
        for seconds, x in ((0, -0.5), (2.5, -0.5), (7.5, 0), (10, 0.25)):
            self.put_cursor(seconds)
            self.assertAlmostEqual(self.browser.run(f"return {WORLD}.positionOf('block')[0]"), x, delta=1e-6)

    def test_times_behind_the_end_of_a_world_are_not_known(self):
        self.open_world("shorter", world=world_file.sample("-4"))
        for seconds, text in ((5, "world at 5.00 s, "), (8, "world at 6.00 s, the last time that is known of it")):
            self.put_cursor(seconds)
            self.assertTrue(self.browser.one(".world-picture figcaption").text.startswith(text))
        self.browser.wait_for("return document.querySelector('.film-track canvas').width > 0")
        self.browser.settle()
        widths = self.browser.run("return [...document.querySelectorAll('.film-track canvas')].map((each) => each.width)")
        known = round(len(widths) * 0.6)
        self.assertEqual([width > 0 for width in widths], [i < known for i in range(len(widths))])

    def test_a_run_that_failed_is_posed_at_its_first_failure(self):
        check = {"name": "limit", "passed": False, "failed_at": 7, "time": 7}
        self.open_world("failed", data=run_of(checks=[check]))
        self.assertEqual(self.browser.run(f"return {WORLD}.posed"), 7)

    def test_a_film_is_in_the_same_place(self):
        self.open_world("film", film=True)
        shown = "return [...document.querySelectorAll('.film-picture')].map((figure) => figure.clientHeight > 0)"
        self.assertEqual(self.browser.run(shown), [False, True])
        film, world = self.browser.all(".switch button")
        film.click()
        self.assertEqual(self.browser.run(shown), [True, False])
        self.assertEqual([button.get_attribute("aria-pressed") for button in (film, world)], ["true", "false"])
        world.click()
        self.assertEqual(self.browser.run(shown), [False, True])
        self.assertEqual(len(self.browser.all(".film-track")), 1)

    def test_a_lost_context_is_said_and_comes_back(self):
        self.open_world("lost")
        before = self.count(RED)
        self.browser.run(f"window.loss = {WORLD}.canvas.getContext('webgl2').getExtension('WEBGL_lose_context');"
                         "window.loss.loseContext()")
        self.browser.wait_for("return !document.querySelector('.world-message').hidden")
        self.assertIn("The browser has taken", self.browser.one(".world-message").text)
        self.browser.run("window.loss.restoreContext()")
        self.browser.wait_for("return document.querySelector('.world-message').hidden")
        self.assertEqual(self.count(RED), before)

    def test_a_file_that_is_broken_inside_is_said_in_words(self):
        sample = world_file.sample()
        self.open_world("broken", world=sample.replace(b'"asset"', b'"asse\xff"'))
        self.assertIn("cannot be shown", self.browser.one(".world-controls .note").text)
        self.assertEqual(len(self.browser.all("[role=alert]")), 0)

    def test_a_page_whose_part_for_worlds_does_not_run_is_whole_without_it(self):
        data = run_of()
        data["worlds"] = [{"component": "world", "file": page_data.pack("uint8", world_file.sample())}]
        data["world_script"] = page_data.pack("uint8", b"this is no script")
        self.open_data("no_script", data)
        self.assertEqual(self.browser.texts(".warning"),
                         ["The world in 3D cannot be shown: its script does not run in this browser."])
        self.assertEqual(len(self.browser.all(".pane")), 1)
        self.assertEqual(len(self.browser.all(".world-picture, .play")), 0)

    def test_a_world_that_names_other_files_loads_none(self):
        world = world_file.WorldFile()
        world.node("box", mesh=world.box([1, 1, 1]))
        self.open_world("elsewhere", world=world.bytes(uri="https://example.org/world.bin"))
        self.assertIn("cannot be shown", self.browser.one(".world-controls .note").text)
        self.assertEqual(self.browser.requests(), [])

    def test_a_page_without_a_world_has_nothing_of_it(self):
        self.open_data("without", run_of())
        self.assertEqual(self.browser.errors(), [])
        self.assertEqual(len(self.browser.all(".world-picture, .world, .play, .player")), 0)
        self.assertTrue(self.browser.run("return window.strideWorld === undefined"))
        self.assertNotIn("Space", "".join(self.browser.texts("dialog kbd")))


class WithoutWebGlTest(WorldPage):
    has_webgl = False

    def test_the_film_is_shown_and_why_the_world_is_not(self):
        self.open_world("film_only", film=True)
        self.assertIn("this browser has no WebGL 2", self.browser.one(".world-controls .note").text)
        self.assertGreater(self.browser.one(".film-picture img").size["height"], 0)
        self.assertFalse(self.browser.one(".world-picture").is_displayed())
        self.assertEqual(self.browser.errors(), [])

    def test_without_a_film_there_is_only_the_line(self):
        self.open_world("nothing")
        self.assertIn("this browser has no WebGL 2", self.browser.one(".world-controls .note").text)
        self.assertEqual([part.is_displayed() for part in self.browser.all(".film-track, .world-picture")], [False] * 2)
        self.assertEqual(self.browser.errors(), [])


if __name__ == "__main__":
    WorldPage.page, WorldPage.script, WorldPage.folder = (Path(argument) for argument in sys.argv[1:4])
    WorldPage.folder.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=[sys.argv[0], *sys.argv[4:]])
