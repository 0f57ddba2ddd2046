// Files that units write: each has a folder of its own among the results, and a hosted one cannot
// make stride follow a link out of it.
#include <cstdlib>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/cli/failures.h"
#include "tests/cli/landlock.h"
#include "tests/master/report/support.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using stride::report::data_of;

namespace {

const std::string kSecret = "time,file\n0,secret.jpg\n";
constexpr const char* kTarget = "outside/frames.csv";

/// A scenario with an intruder of this name, and a file outside of the results.
class Trap {
 public:
  explicit Trap(const std::string& name = "intruder", const std::string& others = "")
      : workspace(Parts{component(name, "intruder.fmu") + others}), name_(name) {
    fs::create_directories(workspace / "outside");
    workspace.scratch().write(kTarget, kSecret);
    workspace.scratch().write("outside/secret.jpg", "secret");
  }

  Outcome run(const std::string& attack, const std::string& call, Arguments further) const {
    return run(attack, call, workspace / kTarget, std::move(further));
  }
  Outcome run(const std::string& attack, const std::string& call, const fs::path& target,
              Arguments further) const {
    for (const auto& [parameter, value] : std::vector<std::pair<std::string, std::string>>{
             {"attack", attack}, {"call", call}, {"target", target.string()}}) {
      further.insert(further.end(), {"--set", name_ + "." + parameter + "=" + value});
    }
    return workspace.run(further);
  }

  /// All that was there, with its old content.
  void check_untouched() const {
    CHECK(read(workspace / kTarget) == kSecret);
    CHECK(read(workspace / "outside/secret.jpg") == "secret");
    CHECK(std::distance(fs::directory_iterator(workspace / "outside"), {}) == 2);
  }

  void check_complete() const {
    CHECK(run_json(workspace)["outcome"] == "completed");
    CHECK(workspace.signals().size() == 1001);
    for (const char* file :
         {"signals.csv", "events.csv", "activity.csv", "signals.vcd", "run.json", "report.html"}) {
      INFO(file);
      CHECK(fs::is_regular_file(fs::symlink_status(workspace / "out" / file)));
      CHECK(fs::file_size(workspace / "out" / file) > 0);
      CHECK_FALSE(
          fs::exists(fs::symlink_status(workspace / "out" / (std::string(file) + ".stride-new"))));
    }
    CHECK(data_of(workspace.result("report.html"))["notes"].empty());
  }

  const Workspace workspace;

 private:
  std::string name_;
};

/// For the attack in the unit's constructor, which has no parameters.
class AttackAtBirth {
 public:
  AttackAtBirth(const std::string& attack, const fs::path& target) {
    ::setenv("STRIDE_TEST_ATTACK", attack.c_str(), 1);
    ::setenv("STRIDE_TEST_TARGET", target.c_str(), 1);
  }
  ~AttackAtBirth() {
    ::unsetenv("STRIDE_TEST_ATTACK");
    ::unsetenv("STRIDE_TEST_TARGET");
  }
};

const Arguments kHosted{"--quiet", "--isolate"};
const Arguments kInProcess{"--quiet"};

}  // namespace

TEST_CASE("a hosted unit cannot put a link or a FIFO in the place of a results file") {
  if (lacks_landlock()) return;
  const std::string attack = GENERATE("links", "FIFOs", "folders");
  const std::string call = GENERATE("instantiate", "initialize", "step", "terminate");
  INFO(attack << " in " << call);
  const Trap trap;
  std::optional<AttackAtBirth> at_birth;
  if (call == "instantiate") at_birth.emplace(attack, trap.workspace / kTarget);
  Arguments arguments = kHosted;
  arguments.insert(arguments.end(), {"--junit", "out/junit.xml"});
  const Outcome outcome = trap.run(attack, call, arguments);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  trap.check_untouched();
  trap.check_complete();
  CHECK(fs::is_regular_file(fs::symlink_status(trap.workspace / "out/junit.xml")));
  CHECK_FALSE(fs::is_symlink(trap.workspace / "out/units"));
  CHECK_FALSE(fs::is_symlink(trap.workspace / "out/units/intruder"));
}

TEST_CASE("the report shows no file that a unit has linked to, and waits for none") {
  const auto [attack, note] = GENERATE(table<std::string, std::string>(
      {{"film",
        "units/intruder/film/frames.csv: 2 of its pictures are left out: they are links, no "
        "regular files, or larger than 16 MiB"},
       {"linked film",
        "units/intruder/film: left out: it is a link, or its list is no regular "
        "file"},
       {"FIFO film",
        "units/intruder/film: left out: it is a link, or its list is no regular "
        "file"}}));
  INFO(attack);
  const Trap trap;
  const Outcome outcome = trap.run(attack, "initialize", kHosted);
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  const nlohmann::json report = data_of(trap.workspace.result("report.html"));
  CHECK(report["notes"].dump().find(note) != std::string::npos);
  for (const nlohmann::json& film : report["films"]) {
    CHECK(film["frames"] == nlohmann::json{"data:image/jpeg;base64,cGljdHVyZQ=="});
  }
  CHECK(report["films"].size() == (attack == "film" ? 1 : 0));
  trap.check_untouched();
}

TEST_CASE("a link that a run has left is gone in the next one") {
  const Trap trap;
  REQUIRE(trap.run("film", "initialize", kHosted).exit_code == 0);
  const fs::path planted = trap.workspace / "out/units/intruder/film/1.jpg";
  REQUIRE(fs::is_symlink(planted));
  trap.workspace.scratch().write("out/units/intruder/film/mine.txt", "mine");
  const Outcome outcome = trap.run("picture", "initialize", kInProcess);
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
  trap.check_untouched();
  CHECK(fs::is_regular_file(fs::symlink_status(planted)));
  CHECK(trap.workspace.result("units/intruder/film/mine.txt") == "mine");
  CHECK_FALSE(fs::exists(fs::symlink_status(trap.workspace / "out/units/intruder/film/2.jpg")));
}

TEST_CASE("a hosted unit cannot write among the results of others") {
  if (lacks_landlock()) return;
  const Trap trap("intruder", component("other", "intruder.fmu"));
  const std::string file =
      GENERATE("out/units/other/note.txt", "out/units/note.txt", "out/note.txt");
  const Outcome outcome = trap.run("target", "step", trap.workspace / file, kHosted);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'intruder'") && Contains("Permission denied") &&
                              Contains("hint: it runs in a sandbox") &&
                              Contains((trap.workspace / "out/units/intruder").string()));
  CHECK_FALSE(fs::exists(trap.workspace / file));
}

TEST_CASE("a unit's files are in the same place in process and with a host") {
  const auto [name, folder] =
      GENERATE(table<std::string, std::string>({{"intruder", "units/intruder"},
                                                {"100% in/out", "units/100%25 in%2Fout"},
                                                {"..", "units/%2E%2E"}}));
  const Trap trap(name, component("another", "intruder.fmu"));
  for (const Arguments& arguments : {kInProcess, kHosted}) {
    INFO(arguments.back());
    const Outcome outcome = trap.run("note", "initialize", arguments);
    CHECK(outcome.err == "");
    CHECK(outcome.exit_code == 0);
    CHECK(trap.workspace.result(folder + "/note.txt") == "written\n");
    CHECK(std::distance(fs::directory_iterator(trap.workspace / "out/units"), {}) == 1);
    fs::remove_all(trap.workspace / "out");
  }
}

TEST_CASE("the folders of units that write nothing are removed at the end") {
  const Trap trap;
  CHECK_THAT(trap.workspace.run({}).out, !Contains("units/"));
  CHECK_FALSE(fs::exists(trap.workspace / "out/units"));
  CHECK_THAT(trap.run("note", "initialize", {}).out,
             Contains("Results in out:") && Contains(" units/\n"));
}

TEST_CASE("what cannot be a unit's folder is named") {
  const Trap trap;
  fs::create_directories(trap.workspace / "out");
  trap.workspace.scratch().write("out/units", "");
  CHECK_THAT(input_error_of(trap.workspace.run({})),
             Contains("out/units: cannot make this folder for files of a unit: Not a directory") ||
                 Contains("out/units: cannot make this folder for files of a unit: File exists"));
}

TEST_CASE("no file of the master's is written to the folders of units") {
  const Workspace workspace(two_filters());
  fs::create_directories(workspace / "out/units");
  fs::create_directory_symlink("out/units/first", workspace / "link");
  const std::string path = GENERATE("out/units/first/x", "out/units/x", "link/x");
  for (const Arguments& options : {Arguments{"--junit", path}, {"--capture", "first=" + path}}) {
    const Outcome outcome = workspace.run(options);
    CHECK_THAT(input_error_of(outcome),
               Contains(options[0] + " " + options[1] +
                        ": the file is in the folder of the files of units"));
    CHECK_FALSE(fs::exists(workspace / path));
  }
}

TEST_CASE("a component with a name that is too long for a folder has one") {
  const std::string name(400, 'n');
  const Workspace workspace(Parts{component(name, "minimal.fmu")});
  CHECK(workspace.run({"--quiet", "--isolate"}).exit_code == 0);
}
