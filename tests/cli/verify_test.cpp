// verify: what it finds out about units that keep what they declare, and about those that do not.
#include <chrono>
#include <csignal>
#include <thread>

#include <nlohmann/json.hpp>

#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/build.h"
#include "tests/cli/scenarios.h"
#include "tests/fuzz/mutator.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

/// The line of the table for this check, or nothing.
std::string row(const Outcome& outcome, const std::string& check) {
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  " + check + " ", 0) == 0) return line;
  }
  return "";
}

Outcome verify(const std::string& unit, const Arguments& further = {}) {
  Arguments arguments{"verify", unit};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return run_program(arguments);
}

Outcome verify_one(const std::string& unit, const std::string& check,
                   const Arguments& further = {}) {
  Arguments arguments{"--check", check};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return verify(unit, arguments);
}

/// The check fails, with this in what was seen.
void check_fails(const std::string& unit, const std::string& check, const std::string& seen,
                 const Arguments& further = {}) {
  CAPTURE(unit, check);
  const Outcome outcome = verify_one(unit, check, further);
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, StartsWith("stride: error: it fails '" + check + "'\n"));
  CHECK_THAT(row(outcome, check), Contains(" FAILED ") && Contains(seen));
  CHECK_THAT(outcome.out, Contains("0 passed, 1 failed, 0 skipped"));
}

/// A folder with an FMU whose description is changed.
struct Altered {
  Scratch scratch;
  fs::path folder = scratch / "unit";

  Altered(const std::string& fmu, const std::string& from, const std::string& to) {
    const stride::importer::UnpackedFmu unpacked(test_fmu(fmu));
    fs::copy(unpacked.folder(), folder, fs::copy_options::recursive);
    std::string text = read(folder / "modelDescription.xml");
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    scratch.write("unit/modelDescription.xml", text.replace(at, from.size(), to));
  }
};

}  // namespace

TEST_CASE("a unit that keeps what it declares passes all checks") {
  const Outcome outcome = verify("lying_none.fmu", {"--instances", "100"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, StartsWith("lying_none: FMI 3.0, steps of 0.001 s to 0.2 s, seed 1\n"));
  CHECK_THAT(outcome.out, Contains(kSanitized ? "14 passed, 0 failed, 3 skipped"
                                              : "15 passed, 0 failed, 2 skipped"));
}

TEST_CASE("each lie is found, with variable, values and time") {
  check_fails("lying_forgets_on_restore.fmu", "restore",
              "at 0.061 s 'steps' is 61 after the save, and 141 after the restore");
  check_fails("lying_forgets_on_restore.fmu", "repetition",
              "at 0.012 s 'steps' is 24 after the save, and 27 when the steps are repeated");
  check_fails("lying_counts_repetitions.fmu", "repetition", "the step from ");
  check_fails("lying_counts_repetitions.fmu", "repetition", " s when the steps are repeated");
  check_fails("lying_forgets_on_restore.fmu", "serialization",
              "'steps' is 61 in the instance that was serialised, and 1 in another one");
  check_fails("lying_forgets_events.fmu", "serialization",
              "in an instance of another process, serialised right after an event");
  check_fails("lying_saves_address.fmu", "serialization",
              "the same state is other bytes in another process");
  check_fails("lying_depends_on_split.fmu", "splitting",
              "where steps of 0.001 s are split into halves, though it declares that steps may be "
              "split (splitInvariant)");
  check_fails("lying_depends_on_split.fmu", "splitting", " 'y' is ");
  check_fails("lying_shares_state.fmu", "instances",
              "at 0.001 s 'steps' is 1 in an instance that is alone, and 3 in one beside others");
  check_fails("lying_hidden_dependency.fmu", "dependencies",
              "at 0 s 'echo' goes from 0 to 2 when 'u' goes from 0 to 1, though its <Output> does "
              "not list that");
  check_fails("lying_forgets_in_reset.fmu", "reset",
              "at 0.001 s 'steps' is 1 in a new instance, and 121 after a reset in Step Mode");
  check_fails("lying_keeps_input_in_reset.fmu", "reset", "'u' is ");
  check_fails(
      "lying_keeps_input_in_reset.fmu", "reset",
      "in Initialization Mode after a reset in Step Mode, though in a new instance it is 0");
  check_fails("lying_ignores_start.fmu", "values",
              "'y' is 0.25 in Initialization Mode, though its start value is 0");
  check_fails("lying_leaves_range.fmu", "values", "which is above its max 0.01");
  check_fails("not_a_number.fmu", "values", "'y' is nan");
  check_fails("lying_not_deterministic.fmu", "determinism", "at 0.001 s 'echo' is ");
  check_fails("lying_breaks_rejection.fmu", "rejection",
              "before, and 0.25053445785019174 after it has rejected a step to 0.047 s");
  check_fails("lying_announces_past.fmu", "events",
              "at 0.031 s it announces its next event for 0.011 s, which is over");
  check_fails(
      "lying_mumbles_messages.fmu", "messages",
      "as 'message' at 0 s is not one line of UTF-8 without control characters: \"\uFFFDmm\"");
  check_fails("lying_counts_questions.fmu", "messages",
              "'steps' is 1 in an instance without requests for message descriptions, and ");
  check_fails("lying_iterates_for_ever.fmu", "events", "do not come to an end: 1000 iterations");
}

TEST_CASE("what is left behind is found") {
  const Arguments few{"--instances", "400"};
  if (kSanitized) {
    CHECK_THAT(row(verify_one("lying_leaks.fmu", "memory", few), "memory"),
               Contains("skipped") && Contains("sanitizers"));
    return;
  }
  // 112, or a little more where malloc() gives out larger blocks
  check_fails("lying_leaks.fmu", "memory", "it leaks 11", few);
  const Arguments allowed{"--instances", "400", "--leak", "112"};
  CHECK_THAT(row(verify_one("lying_leaks.fmu", "memory", allowed), "memory"), Contains("passed"));
  CHECK_THAT(verify_one("lying_leaks.fmu", "memory", allowed).out, Contains("112 are allowed by"));
  const Arguments less{"--instances", "400", "--leak", "90"};
  check_fails("lying_leaks.fmu", "memory", "it leaks 11", less);
  check_fails("lying_leaks_pages.fmu", "memory", "it leaks 0 bytes of heap and", few);
  check_fails("lying_leaks_files.fmu", "memory", "420 instances leave 420 files open", few);
  check_fails("lying_grows_in_steps.fmu", "memory", "while it runs it grows by 11", few);
}

TEST_CASE("a unit that crashes, hangs or ends the process fails a check and no more") {
  check_fails("lying_crashes_in_reset.fmu", "reset",
              "it crashed with signal 11 (SIGSEGV) in fmi3Reset at 0 s");
  check_fails("lying_hangs_in_step.fmu", "events",
              "it did not come to an end in time in fmi3DoStep at 0.02 s (limit: 0.5 s)",
              {"--timeout", "0.5"});
  check_fails("lying_exits_in_step.fmu", "determinism",
              "it ended the process with exit code 3 in fmi3DoStep at 0 s");
  check_fails("thrower.fmu", "events", "fmi3DoStep returned fmi3Error: the fuse has blown");
}

TEST_CASE("rounding, rejections and early returns that the standard allows pass") {
  CHECK_THAT(row(verify_one("linear.fmu", "splitting"), "splitting"),
             Contains("passed") && Contains("the same but for rounding"));
  CHECK_THAT(row(verify_one("wide.fmu", "splitting"), "splitting"),
             Contains("passed") && Contains("other values, which nothing excludes"));
  CHECK_THAT(row(verify_one("rejecter.fmu", "rejection",
                            {"--set", "longest=0.05", "--set", "shortest=0.0002"}),
                 "rejection"),
             Contains("passed") && Contains("steps rejected, nothing changed"));
  CHECK_THAT(row(verify_one("early.fmu", "events"), "events"), Contains("early returns"));
  CHECK_THAT(row(verify_one("rejecter.fmu", "repetition",
                            {"--set", "longest=0.05", "--set", "shortest=0.0002"}),
                 "repetition"),
             Contains("passed") && Contains("stretches of at most ") && Contains("the same bits"));
  CHECK_THAT(row(verify_one("linear.fmu", "repetition"), "repetition"),
             Contains("passed") && Contains("the same bits"));
  CHECK_THAT(row(verify_one("ticker.fmu", "events", {"--set", "announces=0"}), "events"),
             Contains("passed") && Contains(" 0 where they are not allowed"));
}

TEST_CASE("the text of a message can be requested for any bytes") {
  CHECK_THAT(row(verify_one("types.fmu", "messages"), "messages"),
             Contains("passed") && Contains("values of 6 Binary variables have words"));
}

TEST_CASE("capabilities that a unit does not declare are not checked") {
  CHECK_THAT(row(verify_one("stateless.fmu", "restore"), "restore"),
             Contains("skipped") && Contains("it has no canGetAndSetFMUState"));
  CHECK_THAT(row(verify_one("stateless.fmu", "repetition"), "repetition"),
             Contains("skipped") && Contains("it has no canGetAndSetFMUState"));
  CHECK_THAT(row(verify_one("stateless.fmu", "serialization"), "serialization"),
             Contains("skipped") && Contains("it has no canSerializeFMUState"));
  CHECK_THAT(row(verify_one("single.fmu", "instances"), "instances"),
             Contains("skipped") && Contains("canBeInstantiatedOnlyOncePerProcess"));
  CHECK_THAT(row(verify_one("stateless.fmu", "messages"), "messages"),
             Contains("skipped") && Contains("it has no Binary variable"));
}

TEST_CASE("a state that is declared and is not there") {
  const Altered unit("stateless", "canHandleVariable",
                     "canGetAndSetFMUState=\"true\" canHandleVariable");
  const Outcome outcome = verify(unit.folder.string(), {"--instances", "40"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(row(outcome, "description"),
             Contains("FAILED") && Contains("differs from the library's own description"));
  CHECK_THAT(row(outcome, "restore"),
             Contains("FAILED") && Contains("fmi3GetFMUState returned fmi3Error"));
}

TEST_CASE("an output that the model structure forgets") {
  const Altered unit("stepper", "<Output ", "<!-- --><NoOutput ");
  const Outcome outcome = verify_one(unit.folder.string(), "description");
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(row(outcome, "description"), Contains("<ModelStructure> has no <Output> for 'steps'"));
}

TEST_CASE("a library without what is declared fails to load, and nothing else is tried") {
  const Scratch scratch;
  const fs::path folder = make_raw_fmu(scratch, "raw", "canGetAndSetFMUState=\"true\"");
  const Outcome outcome = verify(folder.string());
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(
      row(outcome, "load"),
      Contains("FAILED") && Contains("does not export fmi3GetFMUState, fmi3SetFMUState, "
                                     "fmi3FreeFMUState, which the model description declares"));
  CHECK_THAT(outcome.out, Contains("0 passed, 1 failed, 16 skipped"));
}

TEST_CASE("a unit that is not of the kit may let mistakes pass, which is noted") {
  const Scratch scratch;
  const Outcome outcome = verify_one(make_raw_fmu(scratch, "raw").string(), "calls");
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(row(outcome, "calls"), Contains("passed"));
  CHECK_THAT(outcome.out,
             Contains("note") && Contains("fmi3DoStep in the state Instantiated: accepted"));
}

TEST_CASE("the results are also there for machines") {
  const Scratch scratch;
  const fs::path file = scratch / "results.json";
  const Outcome outcome = verify("lying_ignores_start.fmu", {"--check", "values", "--check",
                                                             "reset", "--json", file.string()});
  CHECK(outcome.exit_code == 1);
  const auto json = nlohmann::json::parse(read(file));
  CHECK(json["model"] == "lying_ignores_start");
  CHECK(json["fmi_version"] == "3.0");
  CHECK(json["good"] == false);
  REQUIRE(json["checks"].size() == 2);
  CHECK(json["checks"][0]["name"] == "values");
  CHECK(json["checks"][0]["verdict"] == "FAILED");
  CHECK_THAT(json["checks"][0]["seen"].get<std::string>(), Contains("'y' is 0.25"));
  CHECK(json["checks"][1]["verdict"] == "passed");
}

TEST_CASE("start values, step, stop and seed can be set") {
  const Outcome outcome =
      verify_one("linear.fmu", "values", {"--step", "0.25", "--stop", "5", "--seed", "7"});
  CHECK_THAT(outcome.out, StartsWith("linear: FMI 3.0, steps of 0.25 s to 5 s, seed 7\n"));
  CHECK_THAT(row(outcome, "values"), Contains("in 20 steps to 5 s"));
  check_fails("thrower.fmu", "determinism", "at 0.05 s: fmi3DoStep returned fmi3Error",
              {"--set", "throw_at=0.051"});
}

TEST_CASE("mistakes in the input are reported, with exit code 2") {
  const auto mistake = [](const Arguments& arguments) {
    const Outcome outcome = run_program(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out == "");
    return outcome.err;
  };
  CHECK_THAT(mistake({"verify", "minimla.fmu"}), Contains("did you mean 'minimal.fmu'?"));
  CHECK_THAT(mistake({"verify", unit_library("minimal").string()}), Contains("stride pack"));
  CHECK_THAT(mistake({"verify", "minimal.fmu", "--set", "tiem_constant=1"}),
             Contains("--set tiem_constant=1") && Contains("time_constant"));
  CHECK_THAT(mistake({"verify", "minimal.fmu", "--set", "u"}), Contains("expected variable=value"));
  CHECK_THAT(mistake({"verify", "minimal.fmu", "--step", "0"}),
             Contains("a step must be above 0 s"));
  CHECK_THAT(mistake({"verify", "minimal.fmu", "--step", "1", "--stop", "2"}),
             Contains("there are 2 steps") && Contains("expected 4 at least"));
  CHECK_THAT(mistake({"verify", "minimal.fmu", "--timeout", "-1"}), Contains("--timeout -1"));
  CHECK_THAT(mistake({"verify", "minimal.fmu", "--instances", "3"}), Contains("--instances"));
  CHECK_THAT(mistake({"verify", "minimal.fmu", "--json", "/nowhere/x.json"}),
             Contains("/nowhere/x.json"));
  const std::string err = run_program({"verify", "minimal.fmu", "--check", "rest"}).err;
  CHECK_THAT(err, Contains("--check rest: there is no such check") && Contains("'reset'"));
}

TEST_CASE("the help names each check") {
  const Outcome outcome = run_program({"verify", "--help"});
  CHECK(outcome.exit_code == 0);
  for (const char* check : {"load", "description", "values", "dependencies", "events", "calls",
                            "messages", "splitting", "rejection", "reset", "instances", "restore",
                            "repetition", "serialization", "memory", "determinism"}) {
    CHECK_THAT(outcome.out, Contains(std::string("\n  ") + check + " "));
  }
}

TEST_CASE("an interruption ends the check and leaves nothing") {
  const Workspace workspace(two_filters());
  Process process(stride_command({"verify", "lying_hangs_in_step.fmu", "--check", "events"}),
                  workspace.scratch().path());
  while (workspace.left_behind().empty() && process.is_running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("interrupted during the check 'events'"));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a damaged archive is refused, and leaves nothing") {
  const Workspace workspace(two_filters());
  const std::string whole = read(test_fmu("lying_none"));
  Mutator mutator(20241121);
  for (int i = 0; i < 20; ++i) {
    workspace.scratch().write("x.fmu", mutator.mutate(whole));
    const Outcome outcome = workspace.stride({"verify", "x.fmu", "--check", "load"});
    CAPTURE(i, outcome.out, outcome.err);
    CHECK((outcome.exit_code == 2 || outcome.exit_code == 0));  // what is damaged may be a date
    if (outcome.exit_code == 2) CHECK_THAT(outcome.err, Contains("x.fmu"));
  }
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a damaged description is refused or judged") {
  const Workspace workspace(two_filters());
  fs::copy(stride::importer::UnpackedFmu(test_fmu("types")).folder(), workspace / "unit",
           fs::copy_options::recursive);
  const std::string whole = read(workspace / "unit/modelDescription.xml");
  Mutator mutator(20241122);
  const int kTrials = kSanitized ? 20 : 150;
  int refused = 0;
  int failed = 0;
  for (int i = 0; i < kTrials; ++i) {
    workspace.scratch().write("unit/modelDescription.xml", mutator.mutate(whole));
    const Outcome outcome = workspace.stride(
        {"verify", "unit", "--instances", "40", "--timeout", "20", "--stop", "0.01"});
    CAPTURE(i, outcome.exit_code, outcome.out, outcome.err);
    CHECK((outcome.exit_code == 0 || outcome.exit_code == 1 || outcome.exit_code == 2));
    CHECK_THAT(outcome.out, !Contains("signal") && !Contains("in time"));
    refused += outcome.exit_code == 2 ? 1 : 0;
    failed += outcome.exit_code == 1 ? 1 : 0;
  }
  CHECK(refused > kTrials / 4);
  CHECK(failed > 0);
  CHECK(workspace.left_behind().empty());
}
