"""A headless Chromium with one page of a report in it."""

import json
import os
import shutil
import sys
import tempfile
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

SWITCHES = ["--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--hide-scrollbars",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            "--window-size=1400,1000"]
WITHOUT_WEBGL = ["--disable-gpu", "--disable-3d-apis"]
IN_SOFTWARE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
PATIENCE = 120  # s, for a page to be read; no measure of how long it takes


def find_or_skip():
    """(browser, driver); ends the test aloud where they are not there."""
    browser, driver = shutil.which("chromium"), shutil.which("chromedriver")
    if browser and driver:
        return browser, driver
    print("SKIPPED: chromium and chromedriver are not installed (chromium, chromium-driver)")
    sys.exit(1 if os.environ.get("CI") == "true" else 77)


class Browser:
    """One browser; each `open` is one page. WebGL is drawn in software, if at all."""

    def __init__(self, webgl=False):
        binary, driver = find_or_skip()
        self.profile = tempfile.mkdtemp()
        options = webdriver.ChromeOptions()
        options.binary_location = binary
        for switch in [*SWITCHES, *(IN_SOFTWARE if webgl else WITHOUT_WEBGL), f"--user-data-dir={self.profile}"]:
            options.add_argument(switch)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(options=options, service=Service(driver))

    def close(self):
        self.driver.quit()
        shutil.rmtree(self.profile, ignore_errors=True)

    def open(self, path, dark=False, width=1400, height=1000):
        return self.open_address(path.resolve().as_uri(), dark, width, height)

    def open_address(self, address, dark=False, width=1400, height=1000):
        self.set_dark(dark)
        self.resize(width, height)
        for kind in ("browser", "performance"):
            self.driver.get_log(kind)  # what was before is not of this page
        self.driver.get(address)
        self.wait_for("return document.getElementById('report').getAttribute('aria-busy') === 'false'"
                      " || document.querySelector('[role=alert]') !== null")
        self.settle()
        return self

    def resize(self, width, height):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def set_dark(self, dark):
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def wait_for(self, condition, *arguments):
        end = time.monotonic() + PATIENCE
        while not self.run(condition, *arguments):
            if time.monotonic() > end:
                raise TimeoutError(condition)
            time.sleep(0.02)

    def settle(self):
        """Waits for two frames, after which the page has drawn what changed."""
        self.driver.execute_async_script(
            "const done = arguments[0]; requestAnimationFrame(() => requestAnimationFrame(done));")

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def texts(self, selector):
        return self.run("return [...document.querySelectorAll(arguments[0])].map((e) => e.textContent)", selector)

    def press(self, *keys):
        for key in keys:
            ActionChains(self.driver).send_keys(key).perform()
        self.settle()

    def press_with_shift(self, key):
        ActionChains(self.driver).key_down(Keys.SHIFT).send_keys(key).key_up(Keys.SHIFT).perform()
        self.settle()

    def move_to(self, x, y):
        """Moves the mouse to a place in the window [px]."""
        actions = ActionChains(self.driver, duration=0)
        actions.w3c_actions.pointer_action.move_to_location(x, y)
        actions.perform()
        self.settle()

    def drag(self, x, to_x, y):
        actions = ActionChains(self.driver, duration=0)
        pointer = actions.w3c_actions.pointer_action
        pointer.move_to_location(x, y).pointer_down().move_to_location(to_x, y).pointer_up()
        actions.perform()
        self.settle()

    def click_at(self, x, y):
        self.drag(x, x, y)

    def errors(self):
        """What the page complained of."""
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] in ("SEVERE", "WARNING")]

    def requests(self):
        """All that was asked for beside the page itself and what stands in it."""
        found = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                url = message["params"]["request"]["url"]
                if not url.startswith("data:") and url != self.driver.current_url:
                    found.append(url)
        return found

    # the parts of the page

    def view(self):
        """(from, until) [s]"""
        return tuple(self.run("return [stride.view.from, stride.view.until]"))

    def plot_box(self):
        """The place of the time axis in the window: (left, right) [px]."""
        return tuple(self.run("const box = document.querySelector('.ruler').getBoundingClientRect();"
                              "return [box.left + 96, box.right]"))

    def pane_middle(self, index=0):
        """The height of the middle of a pane in the window [px], which is scrolled to."""
        return self.run("const box = document.querySelectorAll('.pane .plot')[arguments[0]];"
                        "box.scrollIntoView({block: 'center'}); const at = box.getBoundingClientRect();"
                        "return Math.round((at.top + at.bottom) / 2)", index)

    def put_cursor(self, seconds):
        """Puts the cursor somewhere without a mouse, and returns (exact time, {signal: value text})."""
        self.run("stride.view.moveCursor(arguments[0]); stride.view.flush()", seconds)
        return self.values()

    def values(self):
        time_text = self.one(".cursor-time").text.removeprefix("t = ").removesuffix(" s")
        names = self.run("return [...document.querySelectorAll('.legend li')].map((e) => "
                         "[e.querySelector('.signal-name').textContent.replaceAll('\\u200b', ''),"
                         " e.querySelector('.value').title])")
        return time_text, dict(names)

    def picture(self, path):
        self.driver.save_screenshot(str(path))
