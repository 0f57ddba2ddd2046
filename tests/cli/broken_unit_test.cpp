// FMUs that cannot be used: exit code 2, what is wrong with them, and nothing left on the disk.
#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A scenario with one component whose unit is `source`.
Workspace using_unit(const std::string& source) {
  return Workspace(Parts{component("unit", source)});
}

/// The message of `run`, which has to place the mistake where the scenario names the unit.
std::string mistake_of(const Workspace& workspace) {
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.out == "");
  CHECK_THAT(outcome.err, Contains(workspace.at("<ssd:Component ")));
  CHECK(workspace.left_behind().empty());
  return outcome.err;
}

}  // namespace

TEST_CASE("a .fmu that is not an archive") {
  const Workspace workspace = using_unit("letter.fmu");
  workspace.scratch().write("letter.fmu", "Dear reader,\n");
  CHECK_THAT(mistake_of(workspace), Contains("letter.fmu' is not a zip archive") &&
                                        Contains("expected an FMU: a .fmu archive (zip)"));
}

TEST_CASE("an archive that breaks off") {
  const Workspace workspace = using_unit("half.fmu");
  const std::string whole = read(unit_folder() / "minimal.fmu");
  workspace.scratch().write("half.fmu", whole.substr(0, whole.size() / 2));
  CHECK_THAT(mistake_of(workspace), Contains("half.fmu'") && Contains("damaged"));
}

TEST_CASE("an archive that is not an FMU") {
  const Workspace workspace = using_unit("photos.fmu");
  make_zip(workspace / "photos.fmu", {{"holiday.txt", "sunny"}});
  CHECK_THAT(mistake_of(workspace), Contains("has no modelDescription.xml at its top"));
}

TEST_CASE("an archive cannot write outside its folder") {
  const Workspace workspace = using_unit("evil.fmu");
  const std::string absolute = (workspace / "absolute.txt").string();
  const auto entry = GENERATE_COPY(std::string("../../../escaped.txt"),
                                   std::string("resources/../../../../escaped.txt"), absolute);
  make_zip(workspace / "evil.fmu",
           {{"modelDescription.xml", description_text("evil")}, {entry, "written outside"}});
  CHECK_THAT(mistake_of(workspace), Contains("holds the entry '" + entry + "'"));
  std::vector<std::string> files;
  for (const auto& found : fs::recursive_directory_iterator(workspace.scratch().path())) {
    if (found.is_regular_file()) files.push_back(found.path().filename().string());
  }
  std::sort(files.begin(), files.end());
  CHECK(files == std::vector<std::string>{"evil.fmu", "test.ssd"});
}

TEST_CASE("a model description that is not XML names its line") {
  const Workspace workspace = using_unit("unit");
  workspace.scratch().write("unit/modelDescription.xml", "<fmiModelDescription>\n<a>\n</b>\n");
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("unit/modelDescription.xml:"));
}

TEST_CASE("a unit without a binary for this platform: the error lists those that it has") {
  const Workspace workspace = using_unit("windows");
  workspace.scratch().write("windows/modelDescription.xml", description_text("windows"));
  workspace.scratch().write("windows/binaries/x86_64-windows/windows.dll", "MZ");
  CHECK_THAT(mistake_of(workspace),
             Contains(std::string("no binaries for ") + stride::importer::platform()) &&
                 Contains("it has x86_64-windows"));
}

TEST_CASE("a unit whose libraries are all of other names") {
  const Workspace workspace = using_unit("raw");
  make_raw_fmu(workspace.scratch(), "raw");
  workspace.scratch().write("raw/modelDescription.xml", description_text("other_name"));
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("warning: unit 'unit': its library is 'binaries/") &&
                              Contains("/other_name.so', by the modelIdentifier"));
  workspace.scratch().write(std::string("raw/binaries/") + stride::importer::platform() + "/x.so",
                            "");
  CHECK_THAT(mistake_of(workspace), Contains("other_name.so' is missing"));
}

TEST_CASE("a library without one of the functions of FMI") {
  const Workspace workspace = using_unit("raw_without_do_step");
  make_raw_fmu(workspace.scratch(), "raw_without_do_step");
  CHECK_THAT(mistake_of(workspace), Contains("does not export fmi3DoStep,"));
}

TEST_CASE("a library with an undefined symbol") {
  const Workspace workspace = using_unit("raw_with_undefined_symbol");
  make_raw_fmu(workspace.scratch(), "raw_with_undefined_symbol");
  CHECK_THAT(mistake_of(workspace), Contains("it needs the symbol 'stride_test_nobody_has_this'"));
}

TEST_CASE("a library that needs a shared library which is not there") {
  const Workspace workspace = using_unit("raw_with_missing_library");
  make_raw_fmu(workspace.scratch(), "raw_with_missing_library");
  CHECK_THAT(mistake_of(workspace),
             Contains("it needs the shared library 'libstride_test_absent.so'") &&
                 Contains("LD_LIBRARY_PATH"));
}

TEST_CASE("the error of a failed instantiation gives the reason") {
  const Workspace workspace(Parts{component("refuses", "raw")});
  make_raw_fmu(workspace.scratch(), "raw");
  const Outcome outcome = workspace.run();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'refuses'") && Contains("there is no licence"));
  CHECK(workspace.left_behind().empty());
}
