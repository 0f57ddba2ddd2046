"""A picture of a report, as it opens: picture.py REPORT PICTURE [SECONDS], with the cursor at SECONDS."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from browser import Browser  # noqa: E402

WIDTH = 1280
PANES = 5  # what is below them is not in the picture
# the name of the machine is nobody's business
WITHOUT_HOST = """for (const line of document.querySelectorAll('.origin dd'))
                    line.textContent = line.textContent.replace(/ UTC on .*/, ' UTC')"""


def main(report, picture, seconds=None):
    browser = Browser()
    try:
        browser.open(Path(report), width=WIDTH, height=1000)
        browser.run(WITHOUT_HOST)
        if seconds is not None:
            browser.run("stride.view.holdCursor(arguments[0])", float(seconds))
        browser.wait_for("return [...document.images].every((image) => image.complete)")
        browser.settle()
        browser.resize(WIDTH, browser.run("const pane = document.querySelectorAll('.row.pane')[arguments[0] - 1];"
                                          "return Math.ceil(pane.getBoundingClientRect().bottom)", PANES))
        browser.settle()
        browser.picture(picture)
    finally:
        browser.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
