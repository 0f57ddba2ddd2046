// What a unit in a process of its own may do, and how a user learns of what it may not.
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/cli/failures.h"
#include "tests/cli/landlock.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

const Arguments kIsolated{"--isolate", "--set", "faulty.at=0.5"};

Workspace with_a_filter(const std::string& hosts = "") {
  return Workspace(
      Parts{component("filter", "minimal.fmu") + component("faulty", "faulty.fmu"), "", hosts});
}

Arguments isolated(const Arguments& further) {
  Arguments arguments = kIsolated;
  arguments.insert(arguments.end(), further.begin(), further.end());
  return arguments;
}

Arguments writes(const fs::path& file, Arguments further = {}) {
  further.insert(further.end(), {"--set", "faulty.file=" + file.string()});
  return isolated(further);
}

std::string protections_of(const Workspace& workspace, const std::string& unit) {
  const nlohmann::json run = run_json(workspace);
  for (const nlohmann::json& entry : run["units"]) {
    if (entry["name"] == unit) return entry.at("host").at("protections").dump();
  }
  return {};
}

}  // namespace

TEST_CASE("run.json has the protections of a host") {
  if (lacks_landlock()) return;
  const Workspace workspace = with_a_filter();
  REQUIRE(workspace.run(isolated({"--quiet"})).exit_code == 0);
  const std::string text = protections_of(workspace, "faulty");
  CHECK_THAT(
      text, Contains("no new privileges") && Contains("no network: seccomp") &&
                Contains("read-only files, but for " + (workspace / "out/units/faulty").string()) &&
                Contains("Landlock"));
  CHECK_THAT(protections_of(workspace, "filter"),
             Contains("read-only files, but for " + (workspace / "out/units/filter").string()));
}

TEST_CASE("run.json has the protections of a host of a failed run, too") {
  const Workspace workspace = with_a_filter();
  const Outcome outcome = workspace.run(isolated({"--quiet", "--set", "faulty.fault=abort"}));
  REQUIRE(outcome.exit_code == 1);
  CHECK_THAT(protections_of(workspace, "faulty"), Contains("no new privileges"));
}

TEST_CASE("a hosted unit writes among the run's results") {
  const Workspace workspace = with_a_filter();
  const fs::path file = workspace / "out/units/faulty/notes.txt";
  const Outcome outcome = workspace.run(writes(file, {"--quiet"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.result("units/faulty/notes.txt") == "written\n");
}

TEST_CASE("a unit has a temporary folder, which goes with it") {
  const Workspace workspace = with_a_filter();
  const Outcome outcome =
      workspace.run(isolated({"--quiet", "--set", "faulty.fault=write temporary"}));
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a hosted unit cannot write elsewhere, and the error names the cause") {
  if (lacks_landlock()) return;
  const Workspace workspace = with_a_filter();
  const bool is_absolute = GENERATE(true, false);
  const fs::path file = is_absolute ? workspace / "notes.txt" : fs::path("notes.txt");
  const std::string error = failure_of(workspace, writes(file), "0.499");
  CHECK_THAT(error, Contains("unit 'faulty', at 0.499 s: ") &&
                        Contains("cannot write " + file.string() + ": Permission denied") &&
                        Contains("hint: it runs in a sandbox") && Contains("--no-sandbox") &&
                        Contains((workspace / "out/units/faulty").string()));
  CHECK_FALSE(fs::exists(workspace / "notes.txt"));
}

TEST_CASE("a hosted unit has no network, and the error names the cause") {
  const Workspace workspace = with_a_filter();
  CHECK_THAT(failure_of(workspace, isolated({"--set", "faulty.fault=connect"}), "0.499"),
             Contains("cannot make a socket: Permission denied") && Contains("--no-sandbox"));
}

TEST_CASE("an error unrelated to the sandbox does not mention it") {
  const Workspace workspace = with_a_filter();
  CHECK_THAT(failure_of(workspace, isolated({"--set", "faulty.fault=abort"}), "0.499"),
             !Contains("sandbox"));
}

TEST_CASE("without the sandbox all of that is as in process") {
  const auto [hosts, option] = GENERATE(table<std::string, Arguments>(
      {{"", {"--no-sandbox"}}, {"<stride:Host components=\"faulty\" sandbox=\"false\"/>\n", {}}}));
  const Workspace workspace = with_a_filter(hosts);
  Arguments arguments = writes("notes.txt", {"--quiet", "--set", "faulty.fault=connect"});
  arguments.insert(arguments.end(), option.begin(), option.end());
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(read(workspace / "notes.txt") == "written\n");
  CHECK_THAT(protections_of(workspace, "faulty"), !Contains("Landlock"));
}
