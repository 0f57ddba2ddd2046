"""The page of a campaign in a browser: campaign_test.py PAGE FOLDER

Each test writes its page into FOLDER, and opens it as a user does.
"""

import math
import random
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import page_data  # noqa: E402
from browser import Browser  # noqa: E402
from selenium.webdriver.common.action_chains import ActionChains  # noqa: E402
from selenium.webdriver.common.by import By  # noqa: E402
from selenium.webdriver.common.keys import Keys  # noqa: E402

OUTCOMES = ["passed", "failed", "error", "crashed", "timed out", "missing"]
PASSED, FAILED, CRASHED, MISSING = 0, 1, 3, 5


class Campaign:
    """Made-up cases of three parameters: those whose load is above 8 have failed, and case 7 has crashed."""

    def __init__(self, count=60, seed=1):
        numbers = random.Random(seed)
        self.load = [10 * i / (count - 1) for i in range(count)]
        numbers.shuffle(self.load)
        self.delay = [numbers.gauss(1, 0.1) for _ in range(count)]
        self.unit = [numbers.choice(["old", "new <b>"]) for _ in range(count)]
        self.outcomes = [FAILED if load > 8 else PASSED for load in self.load]
        if count > 7:
            self.outcomes[7] = CRASHED
        self.failed = [i for i, outcome in enumerate(self.outcomes) if outcome not in (PASSED, MISSING)]
        self.linked = {i: f"cases/000/{i:06}/report.html" for i in self.failed}

    @property
    def count(self):
        return len(self.load)

    def data(self, **parts):
        correlation = {"count": self.count, "value": 0.5, "confidence": [0.2, 0.7]}
        unclear = {"count": self.count, "value": -0.1, "confidence": [-0.3, 0.2]}
        both = {"cases": 30, "failed": 6, "confidence": [0.1, 0.37]}
        data = {
            "format": 1, "stride": "test", "wall_time": 12.5, "working_folder": "../..",
            "began": ["2026-11-25T23:59:59Z", "2026-11-26T00:10:00Z"],
            "hosts": [{"name": "left", "cases": 1}, {"name": "right", "cases": self.count - 1}],
            "sources": [{"what": "tank.ssd", "sha256": "0123456789abcdef"}, {"what": "unit tank", "sha256": "f" * 64}],
            "campaign": {"name": "tank <1>", "file": "tank.xosc", "scenario": "tank.ssd", "sampling": "sobol",
                         "random_seed": 7, "keep": "failed", "cases": self.count},
            "outcomes": [{"name": name, "cases": self.outcomes.count(i)} for i, name in enumerate(OUTCOMES)],
            "checks": [{"name": "low", "kind": "always", "passed": 50, "failed": 9, "undecided": 1}],
            "parameters": [{"name": "tank.load", "values": page_data.pack("float64", self.load)},
                           {"name": "pump.delay", "values": page_data.pack("float64", self.delay)},
                           {"name": "pump", "values": page_data.pack_strings(self.unit)},
                           {"name": "same", "values": page_data.pack("float64", [1.5] * self.count)}],
            "aggregates": [{"name": "most", "signal": "tank.level", "function": "max", "values": page_data.pack(
                "float64", [math.nan if i == 7 else 2 * load for i, load in enumerate(self.load)])}],
            "cases": {
                "count": self.count,
                "indices": page_data.pack("int32", range(self.count)),
                "outcomes": page_data.pack("uint8", self.outcomes),
                "wall_times": page_data.pack("float64", [0.01] * self.count),
                "reached": page_data.pack("float64", [1] * self.count),
                "failed_at": page_data.pack("float64", [load / 10 if load > 8 else math.nan for load in self.load]),
                "reasons": page_data.pack_texts(
                    "" if outcome == PASSED else f"low: {load} <i>\nmore"
                    for outcome, load in zip(self.outcomes, self.load)),
                "links": page_data.pack_texts(self.linked.get(i, "") for i in range(self.count)),
                "commands": page_data.pack_texts(f"stride run tank.ssd --set tank.load={load}" for load in self.load),
                "began": page_data.pack_texts(["2026-11-25T23:59:59Z"] * self.count),
                "hosts": page_data.pack_texts(["left <b>"] * self.count)},
            "correlations": [{"parameter": 1, "failure": unclear, "aggregates": [unclear], "margins": []},
                             {"parameter": 0, "failure": correlation, "aggregates": [correlation], "margins": []}],
            "shares": [{"parameter": 2, "count": 2, "values": [{"value": "old", **both}, {"value": "new <b>", **both}]}],
        }
        data.update(parts)
        return data


class CampaignTest(unittest.TestCase):
    page = None
    folder = None

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()

    def open(self, campaign, data=None, **options):
        path = self.folder / f"{self.id().rsplit('.', 1)[-1]}.html"
        page_data.write_page(self.page, data or campaign.data(), path)
        browser = self.browser.open(path, **options)
        browser.settle()
        return browser

    def cases(self):
        """The numbers of the cases in the table."""
        return [int(text) for text in self.browser.texts(".cases tbody td:first-child")]

    def choose(self, label, text):
        select = self.browser.one(f"select[aria-label='{label}']")
        self.browser.run("const [select, text] = arguments;"
                         "select.value = [...select.options].find((o) => o.text === text).value;"
                         "select.dispatchEvent(new Event('change'))", select, text)
        self.browser.settle()

    def test_when_where_and_from_what_the_cases_were_made(self):
        browser = self.open(Campaign())
        browser.one(".made-from summary").click()
        text = browser.one(".made-from").text
        self.assertIn("1 case on left, 59 cases on right, which began from 2026-11-25T23:59:59Z to", text)
        self.assertIn("0123456789ab", text)
        self.assertIn("unit tank", text)
        titles = {cell.get_attribute("title") for cell in browser.all(".cases .command")}
        self.assertEqual({"ran at 2026-11-25T23:59:59Z on left <b>"}, titles)

    def write(self, label, text):
        field = self.browser.one(f"input[aria-label='{label}']")
        self.browser.run("arguments[0].closest('details').open = true", field)
        field.clear()
        field.send_keys(text, Keys.ENTER)
        self.browser.settle()

    def painted(self, selector, name):
        """The number of pixels of a canvas that are nearly of this colour of the style sheet."""
        return self.browser.run("""
            const [selector, name] = arguments;
            const hex = getComputedStyle(document.documentElement).getPropertyValue(name).trim();
            const wanted = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
            const canvas = document.querySelector(selector);
            const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
            let count = 0;
            for (let i = 0; i < pixels.length; i += 4) {
              if (pixels[i + 3] > 150 && wanted.every((value, k) => Math.abs(pixels[i + k] - value) < 12)) ++count;
            }
            return count""", selector, name)

    def test_loads_without_error_and_asks_for_nothing(self):
        browser = self.open(Campaign())
        self.assertEqual(browser.errors(), [])
        self.assertEqual(browser.requests(), [])
        self.assertEqual(browser.texts("h1")[0], "tank <1> FAILED campaign")
        self.assertEqual(browser.driver.title, "FAILED: tank <1> – stride campaign")

    def test_the_top_counts_the_outcomes(self):
        campaign = Campaign()
        browser = self.open(campaign)
        count = len(campaign.failed)
        self.assertEqual(browser.one(".banner.bad").text, f"{count} of 60 cases have not passed")
        numbers = dict(zip(browser.texts(".numbers dt"), browser.texts(".numbers dd")))
        self.assertEqual(numbers, {"cases": "60", "passed": str(60 - count), "failed": str(count - 1), "crashed": "1",
                                   "wall time of all": "12.5 s"})
        self.assertIn("sobol, random seed 7", browser.one(".origin").text)
        self.assertEqual(browser.texts(".checks tbody tr > *"), ["✗", "low", "always", "50", "9", "1"])

    def test_parameters_that_decide_are_first_and_marked(self):
        browser = self.open(Campaign())
        self.assertEqual(browser.texts(".correlations tbody th"), ["tank.load", "pump.delay"])
        self.assertEqual(len(browser.all(".correlations .interval.clear")), 2)
        self.assertEqual(browser.texts(".correlations tbody .there")[0], "0.20 to 0.70")
        self.assertEqual(browser.texts(".shares tbody th"), ["old", "new <b>"])

    def test_the_table_leads_to_results_and_repeats(self):
        campaign = Campaign()
        browser = self.open(campaign)
        self.assertEqual(self.cases(), campaign.failed)
        links = browser.run("return [...document.querySelectorAll('.cases a')].map((a) => a.getAttribute('href'))")
        self.assertEqual(links, [campaign.linked[i] for i in campaign.failed])
        self.assertEqual(browser.texts(".cases .command")[0],
                         f"stride run tank.ssd --set tank.load={campaign.load[campaign.failed[0]]}")
        self.assertIn("<i>", browser.texts(".cases .reason")[0])
        self.assertNotIn("more", browser.texts(".cases .reason")[0])
        browser.one(".cases .copy").click()
        browser.wait_for("return document.querySelector('.cases .copy').textContent === 'Copied'")

    def test_the_table_is_sorted_and_filtered(self):
        campaign = Campaign()
        browser = self.open(campaign)
        head = browser.driver.find_element(By.XPATH, "//button[text()='tank.load']")
        head.send_keys(Keys.ENTER)
        by_load = sorted(campaign.failed, key=lambda i: campaign.load[i])
        self.assertEqual(self.cases(), by_load)
        head.send_keys(Keys.ENTER)
        self.assertEqual(self.cases(), by_load[::-1])
        self.choose("Outcome", "crashed")
        self.assertEqual(self.cases(), [7])
        self.choose("Outcome", "all")
        self.assertEqual(len(self.cases()), 50)
        self.assertEqual(browser.one(".case-table .count").text, "1 – 50 of 60")
        browser.driver.find_element(By.XPATH, "//button[text()='Further →']").click()
        self.assertEqual(len(self.cases()), 10)
        self.choose("Outcome", "not passed")
        browser.one("input[type=search]").send_keys("no such words")
        self.assertEqual(self.cases(), [])

    def test_each_outcome_is_in_the_picture(self):
        browser = self.open(Campaign())
        self.assertIn("Without a value here: 1.", browser.one(".scale-note").text)
        self.assertEqual(self.painted(".plot:not(.parallel) canvas", "--crashed"), 0)
        self.choose("y", "pump.delay")
        for name in ("--passed", "--failed", "--crashed"):
            self.assertGreater(self.painted(".plot:not(.parallel) canvas", name), 10, name)
        self.choose("colour", "most")
        self.assertEqual(self.painted(".plot:not(.parallel) canvas", "--failed"), 0)

    def test_fields_select_and_everything_follows(self):
        campaign = Campaign()
        browser = self.open(campaign)
        self.write("tank.load from", "9")
        chosen = [i for i, load in enumerate(campaign.load) if load >= 9]
        self.assertEqual(browser.one(".selected").text, f"{len(chosen)} of 60 cases selected")
        self.assertEqual(self.cases(), chosen)
        self.assertTrue(browser.one(".brush-mark:not([hidden])").is_displayed())
        heat = browser.texts(".heat:not(.empty) .heat-count")
        self.assertEqual(sum(int(text.removeprefix("of ")) for text in heat), len(chosen))
        self.choose("pump", "old")
        self.assertEqual(self.cases(), [i for i in chosen if campaign.unit[i] == "old"])
        browser.run("document.activeElement.blur()")
        browser.press(Keys.ESCAPE)
        self.assertEqual(browser.one(".selected").text, "all 60 cases")
        self.write("tank.load from", "much")
        self.assertEqual(browser.one("[aria-label='tank.load from']").get_attribute("aria-invalid"), "true")
        self.assertEqual(browser.one(".selected").text, "all 60 cases")

    def place(self, selector):
        return self.browser.run("const box = document.querySelector(arguments[0]); box.scrollIntoView({block: 'center'});"
                                "const at = box.getBoundingClientRect(); return [at.left, at.top, at.right, at.bottom]",
                                selector)

    def drag(self, start, end):
        actions = ActionChains(self.browser.driver, duration=0)
        pointer = actions.w3c_actions.pointer_action
        pointer.move_to_location(*start).pointer_down().move_to_location(*end).pointer_up()
        actions.perform()
        self.browser.settle()

    def test_a_brush_on_an_axis_selects_and_a_click_releases_it(self):
        campaign = Campaign()
        browser = self.open(campaign)
        left, top, right, bottom = (round(value) for value in self.place(".brush"))
        middle = (left + right) // 2
        self.drag((middle, top + 1), (middle, (top + bottom) // 2))
        expected = sum(load >= 5 for load in campaign.load)
        selected = int(browser.one(".selected").text.split()[0])
        self.assertAlmostEqual(selected, expected, delta=2)
        self.drag((middle, bottom - 20), (middle, bottom - 20))
        self.assertEqual(browser.one(".selected").text, "all 60 cases")

    def test_a_rectangle_selects_points_and_a_click_leads_to_the_case(self):
        campaign = Campaign()
        browser = self.open(campaign)
        left, top, right, bottom = (round(value) for value in self.place(".plot:not(.parallel)"))
        self.drag((left + 80, top + 12), (right - 14, (top + bottom) // 2))
        selected = int(browser.one(".selected").text.split()[0])
        self.assertGreater(selected, 10)
        self.assertLess(selected, 45)
        browser.run("stride.selection.clear()")
        browser.settle()
        row = next(i for i, outcome in enumerate(campaign.outcomes) if outcome == PASSED)
        x, y = browser.run("return [stride.scatter.xs[arguments[0]], stride.scatter.ys[arguments[0]]]", row)
        left, top, _, _ = self.place(".plot:not(.parallel)")
        at = (round(left + x), round(top + y))
        browser.move_to(*at)
        self.assertIn(f"case {row}: passed", browser.texts(".tip div"))
        self.drag(at, at)
        self.assertEqual(browser.texts(".cases tr.marked td:first-child"), [str(row)])

    def test_an_outcome_can_be_hidden(self):
        campaign = Campaign()
        browser = self.open(campaign)
        browser.driver.find_element(By.XPATH, "//button[contains(@class,'toggle') and contains(., 'failed')]").click()
        browser.settle()
        self.assertEqual(self.cases(), [7])
        self.assertEqual(self.painted(".plot:not(.parallel) canvas", "--failed"), 0)

    def test_a_heat_map_has_shares_and_empty_fields(self):
        campaign = Campaign()
        browser = self.open(campaign)
        self.assertEqual(browser.one(".heat-map caption").text, "pump.delay over tank.load")
        self.assertGreater(len(browser.all(".heat.empty")), 0)
        self.choose("down", "pump")
        self.assertEqual(browser.texts(".heat-map tbody th"), ["new <b>", "old"])
        counts = [int(text.removeprefix("of ")) for text in browser.texts(".heat .heat-count")]
        self.assertEqual(sum(counts), 60)

    def test_what_is_missing_is_said(self):
        campaign = Campaign(4)
        campaign.outcomes = [PASSED, MISSING, MISSING, MISSING]
        data = campaign.data()
        data["cases"]["outcomes"] = page_data.pack("uint8", campaign.outcomes)
        browser = self.open(campaign, data)
        self.assertIn("3 of 4 cases are missing", browser.one(".warning").text)
        self.assertIn("stride campaign run tank.xosc", browser.one(".warning code").text)
        self.assertEqual(len(self.cases()), 4)
        self.assertEqual(browser.errors(), [])

    def test_coverage_is_a_map_that_leads_to_the_first_case(self):
        campaign = Campaign()
        bins = [{"name": "low × <b>", "count": 9, "first": 0.5, "case": 3}, {"name": "low × off", "count": 0},
                {"name": "high × <b>", "count": 1, "first": 2, "case": 5}, {"name": "high × off", "count": 0,
                                                                           "ignored": True}]
        point = {"name": "both", "kind": "cross", "of": ["level", "lamp"], "at_least": 2, "open": False,
                 "percentage": 33.39, "bins": bins}
        words = {"name": "words", "kind": "words", "signal": "frame", "unit": "", "at_least": 1, "open": True,
                 "percentage": None, "bins": [{"name": "read", "count": 2, "first": 1, "case": 3}]}
        group = {"component": "tank", "goal": 90, "percentage": 33.39, "points": [point, words]}
        browser = self.open(campaign, campaign.data(coverage={"groups": [group]}))
        self.assertEqual(browser.texts(".group-share.bad"), ["33.3 % of a goal of 90 %"])
        self.assertEqual(browser.texts(".bin-matrix tbody th"), ["low", "high"])
        self.assertEqual(browser.texts(".bin-matrix thead th"), ["<b>", "off"])
        states = [cell.get_attribute("class") for cell in browser.all(".bin-matrix .bin")]
        self.assertEqual(states, ["bin hit", "bin missed", "bin few", "bin ignored"])
        depths = browser.run("""return [...document.querySelectorAll(".bin-matrix .bin")].map(
            (cell) => cell.style.getPropertyValue("--depth"))""")
        self.assertEqual(depths, ["100%", "", "55%", ""])  # the more visits, the darker
        self.assertEqual(browser.texts(".coverage tbody td.number")[:2], ["1 of 3", "33.3 %"])
        browser.all(".bin-matrix .bin")[2].click()
        browser.settle()
        self.assertEqual(browser.texts(".tip div"), ["high × <b>", "1 visit", "not visited often enough",
                                                     "first at 2 s of case 5"])
        self.assertEqual(browser.texts(".cases .marked td")[0], "5")
        self.assertEqual(browser.errors(), [])

    def test_a_campaign_in_which_nothing_varies(self):
        campaign = Campaign(1 + 1)
        data = campaign.data(parameters=[], aggregates=[], correlations=[], shares=[], checks=[])
        browser = self.open(campaign, data)
        self.assertEqual(browser.errors(), [])
        self.assertEqual(len(browser.all(".heat-map")), 0)

    def test_very_many_texts_have_no_bars(self):
        campaign = Campaign(150)
        campaign.unit = [f"unit {i}" for i in range(150)]
        browser = self.open(campaign)
        self.assertEqual(browser.texts(".histogram-box h3"), ["tank.load", "pump.delay"])
        self.assertIn("With too many different texts: pump.", browser.texts(".note"))

    def test_where_no_results_were_kept_the_page_says_so(self):
        campaign = Campaign()
        campaign.linked = {}
        data = campaign.data()
        data["campaign"]["keep"] = "none"
        data["cases"]["reached"] = page_data.pack("float64", [0.5] + [1] * (campaign.count - 1))
        browser = self.open(campaign, data)
        self.assertTrue(any(text.startswith("No results of cases were kept") for text in browser.texts(".note")))
        self.assertIn("reached [s]", browser.texts(".cases thead th"))

    def test_of_too_many_cases_the_page_says_so(self):
        campaign = Campaign()
        data = campaign.data()
        data["campaign"]["cases"] = 1000
        self.assertIn("Of 1,000 cases this page holds 60", self.open(campaign, data).one(".warning").text)

    def test_data_of_another_format_is_refused_in_words(self):
        campaign = Campaign()
        self.assertIn("format 2", self.open(campaign, campaign.data(format=2)).one("[role=alert]").text)

    def test_light_and_dark(self):
        ground = "return getComputedStyle(document.body).backgroundColor"
        browser = self.open(Campaign())
        light = browser.run(ground)
        browser.press("d")
        dark = browser.run(ground)
        self.assertNotEqual(light, dark)
        self.assertGreater(self.painted(".plot:not(.parallel) canvas", "--failed"), 10)
        browser.one(".theme").click()
        self.assertEqual(browser.run(ground), light)

    def test_paper_is_light(self):
        browser = self.open(Campaign(), dark=True)
        browser.run("window.printed = []; window.addEventListener('beforeprint', () => printed.push("
                    "document.documentElement.dataset.theme))")
        browser.driver.execute_cdp_cmd("Page.printToPDF", {})
        self.assertEqual(browser.run("return printed"), ["light"])
        self.assertEqual(browser.run("return document.documentElement.dataset.theme"), "dark")

    def test_a_narrow_window_needs_no_scrolling_aside(self):
        browser = self.open(Campaign(), width=480)
        self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), 480)

    def test_ten_thousand_cases(self):
        campaign = Campaign(10_000)
        browser = self.open(campaign)
        self.assertEqual(browser.errors(), [])
        self.assertEqual(browser.one(".case-table .count").text, f"1 – 50 of {len(campaign.failed):,}")
        times = browser.run("""
            const took = (work) => { const start = performance.now(); work(); return performance.now() - start; };
            const { selection, scatter, parallel, report } = stride;
            return {
              brush: took(() => selection.brush(report.parameters[0], [9, 10])),
              scatter: took(() => scatter.draw()),
              parallel: took(() => parallel.draw()),
            };""")
        print("ten thousand cases:", ", ".join(f"{name} {time:.0f} ms" for name, time in times.items()))
        self.assertEqual(browser.run("return stride.selection.count"), sum(load >= 9 for load in campaign.load))


if __name__ == "__main__":
    CampaignTest.page, CampaignTest.folder = (Path(argument) for argument in sys.argv[1:3])
    CampaignTest.folder.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1])
