"""What blocks.py takes from a page, and what it refuses."""

import contextlib
import io
import pathlib
import tempfile
import unittest

import blocks


class BlocksTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.page = self.folder / "page.md"

    def run_on(self, text, *command):
        self.page.write_text(text, encoding="utf-8")
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            status = blocks.main([*command, str(self.page)])
        return status, output.getvalue() + errors.getvalue()

    def extract(self, text):
        return self.run_on(text, "extract", str(self.folder / "out"))

    def test_writes_what_is_marked_and_nothing_else(self):
        status, found = self.extract(
            "```cpp\nint unmarked;\n```\n\n<!-- test: unit tank -->\n```cpp\nint a;\n\nint b;\n```\n"
            "<!-- test: scenario fill -->\n```xml\n<a/>\n```\n"
            "<!-- test: session look -->\n```console\n$ ls\na\n```\n")
        self.assertEqual((status, found), (0, "unit tank\nscenario fill\nsession look\n"))
        self.assertEqual((self.folder / "out/tank/unit.cpp").read_text(), "int a;\n\nint b;\n")
        self.assertEqual((self.folder / "out/fill.ssd").read_text(), "<a/>\n")
        self.assertEqual((self.folder / "out/look.session").read_text(), "$ ls\na\n")

    def test_a_block_that_is_gone_goes_from_the_folder(self):
        self.extract("<!-- test: file a.ssv -->\n```xml\n<a/>\n```\n")
        self.extract("<!-- test: file b.ssv -->\n```xml\n<a/>\n```\n")
        self.assertFalse((self.folder / "out/a.ssv").exists())

    def test_sessions_of_one_name_are_one(self):
        status, found = self.extract("<!-- test: session look -->\n```console\n$ ls\n```\nNow:\n"
                                     "<!-- test: session look -->\n```console\n$ pwd\n```\n")
        self.assertEqual((status, found), (0, "session look\n"))
        self.assertEqual((self.folder / "out/look.session").read_text(), "$ ls\n$ pwd\n")

    def test_a_part_must_stand_in_its_file(self):
        session = "<!-- test: session a -->\n```console\n$ ls\n```\n"
        part = "<!-- test: part tests/docs/blocks_test.py -->\n```python\nimport contextlib\n{}\n```\n"
        self.assertEqual(self.run_on(session + part.format("  import io"), "check")[0], 0)
        status, output = self.run_on(session + part.format("import ioo"), "check")
        self.assertEqual(status, 1)
        self.assertIn("is not in that file", output)
        status, output = self.run_on(session + part.replace("_test.py", "_best.py"), "check")
        self.assertEqual(status, 1)
        self.assertIn("no file tests/docs/blocks_best.py", output)

    def test_a_marker_within_a_block_is_text(self):
        status, found = self.extract("```md\n<!-- test: unit tank -->\n```\n")
        self.assertEqual((status, found.strip()), (0, ""))

    def test_refuses_broken_blocks(self):
        for text, message in {
            "<!-- test: unit tank -->\n\n```cpp\nint a;\n```\n": "page.md:1: expected a fenced block",
            "<!-- test: unit tank -->\n```xml\n<a/>\n```\n": "page.md:1: expected ```cpp",
            "<!-- test: unit tank -->\n```cpp\nint a;\n": "page.md:1: the fenced block has no end",
            "<!-- test: units tank -->\n```cpp\nint a;\n```\n": "page.md:1: 'units tank' is not a test",
            "<!-- test: unit ../tank -->\n```cpp\nint a;\n```\n": "page.md:1: 'unit ../tank' is not a test",
            "<!-- test: file a -->\n```\n1\n```\n<!-- test: file a -->\n```\n2\n```\n": "'file a' differs",
        }.items():
            with self.subTest(text=text):
                status, output = self.extract(text)
                self.assertEqual(status, 1)
                self.assertIn(message, output)

    def test_check_wants_a_block_in_each_page(self):
        status, output = self.run_on("# Nothing\n", "check")
        self.assertEqual(status, 1)
        self.assertIn("no block in it is marked", output)

    def test_check_wants_the_scenario_of_a_result(self):
        status, output = self.run_on("<!-- test: unit a -->\n```cpp\nint a;\n```\n"
                                     "<!-- test: result fill signals.csv -->\n```\ntime\n```\n", "check")
        self.assertEqual(status, 1)
        self.assertIn("not a scenario", output)


if __name__ == "__main__":
    unittest.main()
