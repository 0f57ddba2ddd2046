"""site_search_test.py FOLDER: the search of the site, and its diagrams, in a browser that reaches no network and opens
the pages as files."""

import html
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def page_of(browser, url):
    """The page behind its scripts."""
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-gpu", "--host-resolver-rules=MAP * ~NOTFOUND",
             f"--user-data-dir={profile}", "--virtual-time-budget=20000", "--dump-dom", url],
            check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, timeout=120).stdout


def found(page):
    return re.findall(r'<li class="kind-\w+"[^>]*>\s*<a href="([^"?#]+)', page)


def main(folder):
    browser = shutil.which("chromium")
    if browser is None:
        print("SKIPPED: chromium is not installed")
        return 1 if os.environ.get("CI") == "true" else 77
    site = pathlib.Path(folder).resolve().as_uri()
    mistakes = []
    for words, page in (("rollback", "docs/stepping.html"), ("stride_open", "docs/site/c-api.html"),
                        ("to_pandas", "docs/site/python-api.html")):
        results = found(page_of(browser, f"{site}/search.html?q={words}"))
        if page not in results:
            mistakes.append(f"a search for {words} finds {results}, expected {page} among them")
    if found(page_of(browser, f"{site}/search.html?q=thereisnosuchword")):
        mistakes.append("a search for a word that is nowhere finds something")
    diagrams = re.findall(r'<pre class="mermaid"[^>]*>\s*<svg.*?</svg>', page_of(browser, f"{site}/docs/architecture.html"),
                          flags=re.DOTALL)
    if len(diagrams) != 1 or "observe" not in html.unescape(diagrams[0]):
        mistakes.append("docs/architecture.html: its diagram was not drawn")
    print("\n".join(mistakes) if mistakes else "what is searched is found")
    return 1 if mistakes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
