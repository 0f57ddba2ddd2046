"""The plugin for pytest, in a pytest of its own."""

import importlib.metadata
import zipfile

import pytest
from conftest import CHECKS, scenario
from run_test import _CAMPAIGN


_PARAMETERS = """<ssv:ParameterSet version="1.0" name="p"
    xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues">
<ssv:Parameters><ssv:Parameter name="first.u"><ssv:Real value='{value}'/></ssv:Parameter></ssv:Parameters>
</ssv:ParameterSet>"""


@pytest.fixture
def project(pytester):
    """A project with a scenario of which one of two checks fails, unless first.u is set."""
    pytester.makefile(".ssd", test=scenario("first=minimal second=minimal", "first.y>second.u", CHECKS))
    return pytester


def run(project, *arguments):
    """The plugin is found by its entry point where the package is installed."""
    entries = importlib.metadata.entry_points(group="pytest11")
    is_installed = any(entry.value == "stride.pytest_plugin" for entry in entries)
    return project.runpytest(*([] if is_installed else ["-p", "stride.pytest_plugin"]), *arguments)


def test_checks_of_a_scenario_are_tests(project):
    result = run(project, "test.ssd", "-v")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(
        [
            "*test.ssd::run PASSED*",
            "*test.ssd::it does not overshoot PASSED*",
            "*test.ssd::Eventually second.y (line *) FAILED*",
            "*second.y eventually >= 0.2*",
            "*stride*",
            "*report.html*",
        ]
    )


def test_scenarios_are_found_where_the_project_wants_it(project):
    run(project).assert_outcomes()
    project.makeini("[pytest]\nstride_scenarios = *.ssd")
    run(project).assert_outcomes(passed=2, failed=1)


def test_a_scenario_that_is_wrong_fails_in_each_of_its_tests(project):
    project.makefile(".ssd", test=scenario("first=minimal second=nowhere", "first.y>second.u", CHECKS))
    result = run(project, "test.ssd")
    result.assert_outcomes(failed=3)
    result.stdout.fnmatch_lines(["*nowhere.fmu*"])


def test_one_run_is_shared_by_tests(project):
    project.makepyfile(
        """
        seen = []

        def test_one(stride_run):
            run = stride_run("test.ssd", set={"first.u": 1})
            seen.append(run)
            assert run.passed

        def test_two(stride_run):
            assert stride_run("test.ssd", set={"first.u": 1}).folder == seen[0].folder
            assert stride_run("test.ssd", set={"first.u": 2}).folder != seen[0].folder
        """
    )
    run(project, "-k", "test_").assert_outcomes(passed=2)


def test_runs_with_other_values_or_files_are_others(project):
    project.makepyfile(
        """
        import numpy as np

        def test_values(stride_run):
            values = np.array([0.123456789012]), np.array([0.123456789912])
            one, other = (stride_run("test.ssd", set={"first.u": value}) for value in values)
            assert one.folder != other.folder
            assert stride_run("test.ssd", set={"first.u": 0.123456789012}).folder == one.folder

        def test_folders(stride_run, monkeypatch, tmp_path):
            one = stride_run("test.ssd")
            (tmp_path / "test.ssd").write_bytes(open("test.ssd", "rb").read())
            monkeypatch.chdir(tmp_path)
            assert stride_run("test.ssd").folder != one.folder
        """
    )
    run(project).assert_outcomes(passed=2)


def test_a_run_of_files_that_have_changed_is_another_one(project):
    project.makepyfile(
        """
        import pathlib, pytest, stride

        SCENARIO = pathlib.Path("test.ssd")

        def first(run):
            return run.signals["first.y"][-1]

        def test_it(stride_run):
            before = first(stride_run("test.ssd", set={"first.u": 1}))
            SCENARIO.write_text(SCENARIO.read_text().replace('stopTime="1"', 'stopTime="2"'))
            assert first(stride_run("test.ssd", set={"first.u": 1})) != before

        def test_a_file_that_comes_later(stride_run):
            with pytest.raises(stride.InputError):
                stride_run("later.ssd")
            pathlib.Path("later.ssd").write_text(SCENARIO.read_text())
            assert stride_run("later.ssd").reached == 2

        def test_what_a_test_does_to_the_account(stride_run):
            stride_run("test.ssd", set={"first.u": 1}).info["reached"] = 9

        def test_is_not_seen_by_others(stride_run):
            assert stride_run("test.ssd", set={"first.u": 1}).reached == 2
        """
    )
    run(project).assert_outcomes(passed=4)


def test_a_run_is_made_again_where_another_unit_would_be_found(project):
    project.makepyfile(
        """
        import os, pathlib, shutil

        def test_a_unit_beside_the_scenario(stride_run):
            before = stride_run("test.ssd")
            assert stride_run("test.ssd").folder == before.folder
            found = next(
                source["path"] for source in before.info["provenance"]["sources"] if source["path"].endswith("minimal.fmu")
            )
            copy = shutil.copytree if os.path.isdir(found) else shutil.copy
            copy(found, "minimal.fmu")
            after = stride_run("test.ssd")
            assert str(pathlib.Path("minimal.fmu").absolute()) in [
                source["path"] for source in after.info["provenance"]["sources"]
            ]

        def test_settings_of_the_environment(stride_run, monkeypatch, tmp_path):
            before = stride_run("test.ssd")
            monkeypatch.setenv("STRIDE_UNITS", f"{tmp_path}:{os.environ['STRIDE_UNITS']}")
            assert stride_run("test.ssd").folder != before.folder

        def test_results_that_are_gone(stride_run):
            before = stride_run("test.ssd")
            shutil.rmtree(before.folder)
            assert stride_run("test.ssd").folder.is_dir()
        """
    )
    run(project).assert_outcomes(passed=3)


def test_a_run_is_made_again_where_a_file_that_an_option_names_has_changed(project):
    project.makefile(".ssv", gains=_PARAMETERS.format(value=1))
    project.makepyfile(
        """
        import pathlib, shutil, zipfile

        def test_parameters(stride_run):
            first = lambda: stride_run("test.ssd", parameters="gains.ssv").signals["first.y"][-1]
            before = first()
            assert first() == before
            file = pathlib.Path("gains.ssv")
            file.write_text(file.read_text().replace("value='1'", "value='-1'"))
            assert first() == -before

        def test_an_unpacked_unit(stride_run, tmp_path):
            packed = stride_run("test.ssd").info["provenance"]["sources"][-1]["path"]
            zipfile.ZipFile(packed).extractall(tmp_path / "unit")
            folder = lambda: stride_run("test.ssd", swap={"first": tmp_path / "unit"}).folder
            before = folder()
            assert folder() == before
            description = tmp_path / "unit" / "modelDescription.xml"
            description.write_text(description.read_text() + "<!-- another one -->")
            assert folder() != before
        """
    )
    run(project).assert_outcomes(passed=2)


def test_threads_that_want_the_same_run_have_one(project):
    project.makepyfile(
        """
        from concurrent.futures import ThreadPoolExecutor

        def test_it(stride_run):
            with ThreadPoolExecutor(6) as threads:
                runs = threads.map(lambda _: stride_run("test.ssd", stop=3), range(6))
            assert len({run.folder for run in runs}) == 1
        """
    )
    run(project).assert_outcomes(passed=1)


def test_a_scenario_that_is_no_path(project):
    project.makepyfile(
        """
        import pytest, stride

        @pytest.mark.parametrize("name", [b"test.ssd", 3, None, "a\\0"])
        def test_it(stride_run, name):
            with pytest.raises(stride.InputError, match="the scenario"):
                stride_run(name)
        """
    )
    run(project).assert_outcomes(passed=4)


def test_a_run_that_fails_is_made_once(project):
    project.makefile(".ssd", fuse=scenario("first=minimal fuse=thrower"))
    project.makepyfile(
        """
        import pytest, stride

        def failure(stride_run):
            with pytest.raises(stride.RunError, match="the fuse has blown") as caught:
                stride_run("fuse.ssd", set={"fuse.throw_at": 0.5})
            return caught.value

        def test_it(stride_run):
            assert failure(stride_run) is failure(stride_run)
        """
    )
    run(project).assert_outcomes(passed=1)


def test_shared_runs_have_no_folder_of_their_own(project):
    project.makepyfile(
        """
        def test_it(stride_run):
            stride_run("test.ssd", out="results")
        """
    )
    result = run(project)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*MisuseError: results are where pytest keeps temporary folders*"])


def test_checks_in_one_line_and_with_any_name_are_tests_of_their_own(project):
    one_line = CHECKS.replace("\n", " ").replace(
        "<stride:Eventually", '<stride:Always signal="first.y" max="-1" name="a::b [c]"/> <stride:Eventually', 1
    )
    project.makefile(".ssd", test=scenario("first=minimal second=minimal", "first.y>second.u", one_line))
    result = run(project, "test.ssd", "-v")
    result.stdout.fnmatch_lines(["*test.ssd::it does not overshoot PASSED*", "*test.ssd::a: b (c) FAILED*"])
    again = run(project, "test.ssd", "--last-failed", "-v")
    again.stdout.fnmatch_lines(["*test.ssd::a: b (c) FAILED*"])


def test_a_check_may_be_called_as_the_run(project):
    names = ["run", "run (2)", "run (3)"]
    always = "\n".join(f'<stride:Always name="{name}" signal="second.y" max="2"/>' for name in names)
    check = f"<stride:Checks>{always}</stride:Checks>"
    project.makefile(".ssd", named=scenario("first=minimal second=minimal", "first.y>second.u", check))
    result = run(project, "named.ssd", "-v")
    result.assert_outcomes(passed=4)
    ids = [line.partition("::")[2].partition(" PASSED")[0] for line in result.outlines if " PASSED" in line]
    assert len(ids) == len({*ids}) == 4 and ids[:2] == ["run", "run (2)"]


def test_packages_and_fmus_are_tests(project):
    with zipfile.ZipFile(project.path / "pack.ssp", "w") as package:
        package.write("test.ssd", "SystemStructure.ssd")
    result = run(project, "pack.ssp", "-v")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*pack.ssp::run PASSED*", "*pack.ssp::it does not overshoot PASSED*"])
    (project.path / "endless.ssd").write_text((project.path / "test.ssd").read_text().replace('stopTime="1"', ""))
    result = run(project, "endless.ssd")
    result.stdout.fnmatch_lines(["*pytest has no --stop: a test in Python has, stride_run('endless.ssd', stop=…)*"])
    (project.path / "broken.fmu").write_text("no archive")
    result = run(project, "broken.fmu")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*broken.fmu*"])


def test_a_failing_test_names_the_report(project):
    project.makepyfile(
        """
        def test_it(stride_run):
            stride_run("test.ssd").check()
        """
    )
    result = run(project)
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["*AssertionError: the run has failed*", "*- stride -*", "*/001-test/report.html"])


def test_cases_of_a_campaign(project):
    project.makefile(".xosc", inputs=_CAMPAIGN)
    project.makepyfile(
        """
        import pytest

        @pytest.mark.stride_campaign("inputs.xosc")
        def test_case(stride_case):
            run = stride_case.run()
            assert run.signals["first.y"][-1] == pytest.approx(float(stride_case.parameters["first.u"]) * 0.6321, abs=1e-3)
            run.check()
        """
    )
    result = run(project, "-v")
    result.assert_outcomes(passed=2, failed=1)
    result.stdout.fnmatch_lines(["*test_case?case 0? FAILED*", "*test_case?case 2? PASSED*"])


def test_a_campaign_that_is_missing(project):
    project.makepyfile(
        """
        import pytest

        @pytest.mark.stride_campaign("nowhere.xosc")
        def test_case(stride_case):
            pass

        def test_none(stride_case):
            pass
        """
    )
    result = run(project)
    result.stdout.fnmatch_lines(["*nowhere.xosc*"])
    assert result.ret != 0


@pytest.mark.parametrize("is_known", [True, False])
def test_a_campaign_whose_cases_are_not_taken(project, is_known):
    project.makefile(".xosc", inputs=_CAMPAIGN)
    project.makepyfile(
        f"""
        import pytest

        pytestmark = [pytest.mark.stride_campaign("inputs.xosc")] if {is_known} else []

        {"" if is_known else '@pytest.mark.stride_campaign("inputs.xosc")'}
        def test_none():
            pass

        def test_case(request):
            pass
        """
    )
    result = run(project)
    if is_known:  # a mark of the module is for those that take it
        result.assert_outcomes(passed=2)
        return
    assert result.ret != 0
    result.stdout.fnmatch_lines(["*test_none has the mark stride_campaign: take the cases, with the fixture stride_case*"])
