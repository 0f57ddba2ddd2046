// Units on other machines, as a user meets them: `exec:` with the program of this build in place of
// another machine.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <random>
#include <thread>

#include <nlohmann/json.hpp>

#include "master/loader/network/greeting.h"
#include "tests/cli/leftovers.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string serve_command(const std::string& further = "") {
  return "exec:exec " + stride_program().string() + " serve" + further;
}

/// Of a server, for printf.
std::string greeting() {
  return "\\001STRIDE-SERVE protocol " + std::to_string(stride::remote::kProtocol) + ", build 1\\n";
}

std::string host(const std::string& components, const std::string& further = "",
                 const std::string& at = serve_command()) {
  return "<stride:Host components=\"" + components + "\" at=\"" + at + "\" " + further + "/>\n";
}

Parts with_annotation(Parts parts, const std::string& annotation) {
  parts.annotation = annotation;
  return parts;
}

const Arguments kHalfSecond{"--set", "first.u=1", "--stop", "0.5", "--quiet"};

nlohmann::json host_entry(const Workspace& workspace, std::size_t unit) {
  return nlohmann::json::parse(workspace.result("run.json"))["units"][unit].value("host",
                                                                                  nlohmann::json());
}

std::size_t count_of(const std::string& part, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) {
    ++count;
  }
  return count;
}

/// The error of a run that cannot begin; nothing stays.
std::string error_of_start(const std::string& annotation, int code = 2) {
  const Leftovers leftovers;
  const Workspace workspace(with_annotation(two_filters(), annotation));
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == code);
  CHECK(leftovers.after_a_while().empty());
  CHECK(workspace.left_behind().empty());
  return outcome.err;
}

}  // namespace

TEST_CASE("a unit behind stride serve changes no byte of the results, and nothing stays") {
  const Leftovers leftovers;
  const Workspace near(two_filters());
  REQUIRE(near.run(kHalfSecond).exit_code == 0);
  const Workspace workspace(with_annotation(two_filters(), host("*")));
  const Outcome outcome = workspace.run(kHalfSecond);
  CHECK(outcome.exit_code == 0);
  CHECK(workspace.result("signals.csv") == near.result("signals.csv"));
  for (const std::size_t unit : {0, 1}) {
    const auto entry = host_entry(workspace, unit);
    CHECK(entry["machine"] == serve_command().substr(5));
    CHECK(entry["link"]["round_trips"] >= 500);
    CHECK(entry["link"]["sent"] > 0);
    CHECK(entry["memory"] > 0);
  }
  CHECK(leftovers.after_a_while().empty());
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("--at names a machine for this run") {
  const Workspace workspace(two_filters());
  Arguments options = kHalfSecond;
  options.insert(options.end(), {"--at", "sec*=" + serve_command()});
  CHECK(workspace.run(options).exit_code == 0);
  CHECK(host_entry(workspace, 0).is_null());
  CHECK(host_entry(workspace, 1).contains("machine"));
  CHECK_THAT(workspace.run({"--at", "second"}).err, Contains("expected COMPONENT=PLACE"));
  CHECK_THAT(workspace.run({"--at", "second=box"}).err, Contains("is no place for a unit"));
  CHECK_THAT(workspace.run({"--at", "third=exec:x"}).err, Contains("third"));
}

TEST_CASE("the description comes from there, and the local file need not exist") {
  Parts parts = two_filters();
  parts.components = component("first", "minimal.fmu") + component("second", "not/here/secret.fmu");
  const std::string only = serve_command(" --only minimal.fmu");
  const Workspace workspace(with_annotation(parts, host("second", "fmu=\"\"", only)));
  CHECK(workspace.run(kHalfSecond).exit_code == 0);
  const Workspace other(with_annotation(parts, host("second", "", only)));
  const Outcome outcome = other.run(kHalfSecond);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("'secret.fmu' is not offered there") &&
                              Contains("what is offered: 'minimal.fmu'") &&
                              Contains(other.at("<stride:Host")));
}

TEST_CASE("a pinned FMU that has become another one is told by its name only") {
  Parts parts = two_filters();
  parts.components = component("first", "minimal.fmu") + component("second", "own.fmu");
  const Workspace workspace(with_annotation(parts, host("second", "", "exec:sh serve.sh")));
  const std::string serve =
      "exec " + stride_program().string() + " serve --only \"$PWD/own.fmu\"\n";
  const auto copy = [](const fs::path& fmu) { return "cp " + fmu.string() + " own.fmu\n"; };
  workspace.scratch().write("serve.sh", "if test -e described; then\n" +
                                            copy(test_unit_folder() / "judge.fmu") + "else\n" +
                                            copy(unit_folder() / "minimal.fmu") +
                                            "fi\ntouch described\n" + serve);
  const Outcome outcome = workspace.run(kHalfSecond);
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("'own.fmu' there has changed since its description was read"));
}

TEST_CASE("a file is sent where that is allowed") {
  Parts parts = two_filters();
  parts.components = component("first", "minimal.fmu") +
                     component("second", (unit_folder() / "minimal.fmu").string());
  const Workspace near(parts);
  REQUIRE(near.run(kHalfSecond).exit_code == 0);
  const Workspace workspace(with_annotation(
      parts, host("second", "send=\"true\"", serve_command(" --accept-files --only judge.fmu"))));
  CHECK(workspace.run(kHalfSecond).exit_code == 0);
  CHECK(workspace.result("signals.csv") == near.result("signals.csv"));
  CHECK(workspace.left_behind().empty());
  CHECK_THAT(error_of_start(host("second", "send=\"true\"")),
             Contains("no files are accepted there"));
}

TEST_CASE("a file that is sent is no larger than the limit there, packed or unpacked") {
  const Scratch scratch;
  const auto error_with = [&](const std::string& content, const std::string& limit) {
    const fs::path fmu = make_zip(
        scratch / "large.fmu",
        {{"modelDescription.xml", description_text("large")}, {"resources/content", content}});
    const Workspace workspace(
        Parts{component("unit", fmu.string()), "",
              host("unit", "send=\"true\"", serve_command(" --accept-files" + limit))});
    const Outcome outcome = workspace.run({"--quiet"});
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains(workspace.at("<ssd:Component") + "unit 'unit': "));
    CHECK(workspace.left_behind().empty());
    return outcome.err;
  };
  const std::string zeros(2'000'000, '\0');
  std::string noise(2'000'000, '\0');
  std::mt19937 random(1);
  std::ranges::generate(noise, [&] { return static_cast<char>(random()); });
  const std::string hint = "hint: have it served with a larger --file-limit";
  CHECK_THAT(error_with(zeros, " --file-limit 1"),
             Contains("'large.fmu' unpacks to more than 1048576 bytes") && Contains(hint));
  CHECK_THAT(error_with(noise, " --file-limit 1"),
             Contains("'large.fmu' has more than 1048576 bytes") && Contains(hint));
  for (const std::string limit : {" --file-limit 2", ""}) {
    CHECK_THAT(error_with(noise, limit), !Contains(hint));  // it has no library
  }
  CHECK_THAT(run_program({"serve", "--file-limit", "1"}).err, Contains("--accept-files"));
}

TEST_CASE("run.json and checkpoints know a unit that stays elsewhere by its description") {
  const Scratch machine;
  const fs::path unit = machine / "filter";
  fs::copy(stride::importer::UnpackedFmu(unit_folder() / "minimal.fmu").folder(), unit,
           fs::copy_options::recursive);
  const Workspace workspace(
      with_annotation(two_filters(), host("second", "fmu=\"" + unit.string() + "\"")));
  const auto known = [&] {
    nlohmann::json found;
    const auto run = nlohmann::json::parse(workspace.result("run.json"));
    for (const auto& source : run["provenance"]["sources"]) {
      if (source["what"] == "the description of a unit on another machine") found.push_back(source);
    }
    REQUIRE(found.size() == 1);
    return found[0];
  };
  const Arguments options{"--set", "first.u=1", "--stop", "0.3", "--quiet", "--checkpoint", "0.2"};
  REQUIRE(workspace.run(options).exit_code == 0);
  const nlohmann::json before = known();
  CHECK(before["path"] == serve_command().substr(5) + ":" + unit.string());
  REQUIRE(workspace.stride({"resume", "out", "--quiet"}).exit_code == 0);
  CHECK(known() == before);

  std::ofstream(unit / "modelDescription.xml", std::ios::app) << "<!-- another one -->\n";
  const Outcome resumed = workspace.stride({"resume", "out", "--quiet"});
  CHECK(resumed.exit_code == 2);
  CHECK_THAT(resumed.err, Contains("the description of a unit on another machine, ") &&
                              Contains("is not what it was"));
  REQUIRE(workspace.run(options).exit_code == 0);
  CHECK(known()["path"] == before["path"]);
  CHECK(known()["sha256"] != before["sha256"]);
}

TEST_CASE("attributes that contradict each other are refused with their line") {
  const auto refusal = [](const std::string& attributes) {
    const Workspace workspace(with_annotation(
        two_filters(), "<stride:Host components=\"second\" " + attributes + "/>\n"));
    const Outcome outcome = workspace.run({"--quiet"});
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains(workspace.at("<stride:Host")));
    return outcome.err;
  };
  CHECK_THAT(refusal("fmu=\"x.fmu\""), Contains("fmu is for a unit on another machine"));
  CHECK_THAT(refusal("send=\"true\""), Contains("send is for a unit on another machine"));
  CHECK_THAT(refusal("at=\"exec:x\" process=\"false\""),
             Contains("at is for a unit with a process"));
  CHECK_THAT(refusal("at=\"exec:x\" fmu=\"a.fmu\" send=\"true\""),
             Contains("leave one of them out"));
  CHECK_THAT(refusal("at=\"ssh://-x\""), Contains("'-x' is no name of a machine"));
  CHECK_THAT(refusal("at=\"exec:x\" stride=\"y\""), Contains("it belongs into the command"));
  CHECK_THAT(refusal("at=\"exec:x\" silenceLimit=\"0\""), Contains("silenceLimit"));
}

TEST_CASE("stride check tries the machine, and says what its distance costs") {
  const Workspace workspace(with_annotation(two_filters(), host("second")));
  const Outcome outcome = workspace.stride({"check", "test.ssd"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("On other machines") && Contains("round trip [ms]") &&
                              Contains("1000 communication steps wait for a round trip"));
}

TEST_CASE("a machine without stride is an error with what it says") {
  const std::string missing = error_of_start(host("second", "", "exec:/no/stride serve"), 1);
  CHECK_THAT(missing, Contains("there is no stride serve on") && Contains("code 127") &&
                          Contains("/no/stride") && Contains("hint: install stride there"));
  const std::string chatty =
      error_of_start(host("second", "", "exec:echo Welcome; echo oh dear &gt;&amp;2; exit 3"), 1);
  CHECK_THAT(chatty, Contains("ended with the code 3") && Contains("it printed: Welcome") &&
                         Contains("it said: oh dear"));
}

TEST_CASE("an error has the command of its machine once") {
  const Workspace workspace(two_filters());
  const std::string missing = "/no/stride serve";
  CHECK(count_of(missing, workspace.run({"--quiet", "--at", "second=exec:" + missing}).err) == 1);
  const std::string other = stride_program().string() + " serve --only judge.fmu";
  const Outcome refused = workspace.run({"--quiet", "--at", "second=exec:" + other});
  CHECK_THAT(refused.err, Contains("--at second: " + other + ": 'minimal.fmu' is not offered"));
  CHECK(count_of(other, refused.err) == 1);
}

TEST_CASE("what is printed before the greeting does no harm, and what comes between does") {
  const Workspace workspace(with_annotation(
      two_filters(),
      host("second", "", "exec:echo Welcome; exec " + stride_program().string() + " serve")));
  Arguments options = kHalfSecond;
  options.push_back("--verbose");
  const Outcome outcome = workspace.run(options);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err, Contains("printed before stride serve began: 'Welcome"));
}

TEST_CASE("another version of the protocol is an error that names both") {
  const std::string other =
      "exec:printf '\\001STRIDE-SERVE protocol 99, build 7.7\\n'; cat &gt; /dev/null";
  CHECK_THAT(error_of_start(host("second", "", other), 1),
             Contains("stride 7.7 on") && Contains("has protocol 99") &&
                 Contains(std::string("stride ") + STRIDE_VERSION + " here has protocol " +
                          std::to_string(stride::remote::kProtocol)));
}

TEST_CASE("a machine that is silent is an error when its time is over") {
  CHECK_THAT(error_of_start(host("second", "connectLimit=\"0.3\"", "exec:cat &gt; /dev/null"), 1),
             Contains("has not answered within 0.3 s"));
  const std::string greets_only = "exec:printf '" + greeting() + "'; cat &gt; /dev/null";
  CHECK_THAT(error_of_start(host("second", "silenceLimit=\"0.3\"", greets_only), 1),
             Contains("has given no sign of life for 0.3 s in the description"));
}

TEST_CASE("a machine whose unit computes for long gives signs of life") {
  const Workspace workspace(
      Parts{component("faulty", "faulty.fmu"), "", host("faulty", "silenceLimit=\"0.8\"")});
  const Outcome outcome = workspace.run(
      {"--quiet", "--stop", "0.1", "--set", "faulty.fault=doze", "--set", "faulty.at=0.05"});
  CHECK(outcome.err == "");
  CHECK(outcome.exit_code == 0);
}

TEST_CASE("a full disk there is an error with the file") {
  Parts parts{
      component("unit", (test_unit_folder() / "faulty.fmu").string()), "",
      host("unit", "send=\"true\"",
           "exec:ulimit -f 1; exec " + stride_program().string() + " serve --accept-files")};
  const Workspace workspace(parts);
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("'faulty.fmu' cannot be written there: File too large"));
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("a run that is interrupted while a unit there hangs ends, and nothing stays") {
  const Leftovers leftovers;
  const Workspace workspace(Parts{component("faulty", "faulty.fmu"), "", host("faulty")});
  Process process(stride_command({"run", "test.ssd", "--out", "out", "--quiet", "--set",
                                  "faulty.fault=loop", "--set", "faulty.at=0.05"}),
                  workspace.scratch().path());
  while (process.is_running() && leftovers.processes("faulty").empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));  // until it hangs
  process.send(SIGINT);
  const Outcome outcome = process.wait();
  CHECK_THAT(outcome.err, Contains("the run was interrupted"));
  CHECK(leftovers.after_a_while().empty());
}

TEST_CASE("an interruption ends the wait for a machine that does not answer") {
  const Leftovers leftovers;
  const Workspace workspace(with_annotation(two_filters(), host("second", "", "exec:sleep 30")));
  Process run(stride_command({"run", "test.ssd", "--quiet", "--out", "out"}),
              workspace.scratch().path());
  while (run.is_running() && leftovers.processes("sleep").empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  run.send(SIGTERM);
  const Outcome outcome = run.wait();
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("the run was interrupted"));
  CHECK(leftovers.after_a_while().empty());
}

TEST_CASE("a run that goes on from a checkpoint has the same bytes") {
  const Workspace near(two_filters());
  REQUIRE(near.run(kHalfSecond).exit_code == 0);
  const Workspace workspace(with_annotation(two_filters(), host("second")));
  Arguments options{"--set", "first.u=1", "--stop", "0.3", "--quiet", "--checkpoint-every", "0.1"};
  CHECK(workspace.run(options).exit_code == 0);
  const Outcome outcome = workspace.stride({"resume", "out", "--stop", "0.5", "--quiet"});
  CHECK(outcome.err == "");
  CHECK(workspace.result("signals.csv") == near.result("signals.csv"));
}

TEST_CASE("a peer that sends no messages is refused") {
  const std::string garbage = "exec:printf '" + greeting() + "'; echo what now; cat &gt; /dev/null";
  CHECK_THAT(error_of_start(host("second", "", garbage), 1),
             Contains("sends what cannot be read") && Contains("'what now'"));
}

TEST_CASE("a link that is lost in the run ends it with the results up to there") {
  const Leftovers leftovers;
  const std::string dying =
      "exec:(sleep 1.5; kill -9 $$) &amp; exec " + stride_program().string() + " serve";
  const Workspace workspace(with_annotation(two_filters(), host("second", "", dying)));
  const Outcome outcome =
      workspace.run({"--set", "first.u=1", "--stop", "10000", "--quiet", "--no-trace"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("unit 'second', at ") && Contains("the link to ") &&
                              Contains("has ended in "));
  CHECK(count_of("sleep 1.5; kill -9", outcome.err) == 1);
  CHECK(workspace.signals().size() > 100);
  CHECK(leftovers.after_a_while().empty());
}

TEST_CASE("what a unit does there is the error that it is in a host here, with the machine") {
  const Leftovers leftovers;
  const auto error_of_fault = [](const std::string& fault, const std::string& hosting) {
    const Workspace workspace(
        Parts{component("filter", "minimal.fmu") + component("faulty", "faulty.fmu"), "", hosting});
    const Outcome outcome =
        workspace.run({"--quiet", "--set", "faulty.fault=" + fault, "--set", "faulty.at=0.5"});
    CHECK(outcome.exit_code == 1);
    CHECK(workspace.signals().size() > 490);
    CHECK(workspace.left_behind().empty());
    return outcome.err;
  };
  const std::string machine = serve_command().substr(5);
  for (const std::string fault : {"segfault", "exit", "kill"}) {
    INFO(fault);
    std::string here = error_of_fault(fault, "<stride:Host components=\"faulty\"/>\n");
    const std::string context = "unit 'faulty', at 0.499 s: ";
    REQUIRE_THAT(here, Contains(context));
    here.insert(here.find(context) + context.size(), machine + ": ");
    CHECK(error_of_fault(fault, host("faulty")) == here);
  }
  CHECK_THAT(error_of_fault("loop", host("faulty", "timeout=\"0.5\"")),
             Contains("it took longer than 0.5 s in fmi3DoStep"));
  CHECK(leftovers.after_a_while().empty());
}

TEST_CASE("what a unit prints there is in the log with the machine, and its files come back") {
  const auto run_with = [](const std::string& fault) {
    auto workspace =
        std::make_unique<Workspace>(Parts{component("faulty", "faulty.fmu"), "", host("faulty")});
    const Outcome outcome = workspace->run({"--verbose", "--stop", "0.1", "--set",
                                            "faulty.fault=" + fault, "--set", "faulty.at=0.05"});
    CHECK(outcome.exit_code == 0);
    return std::pair(std::move(workspace), outcome.err);
  };
  CHECK(read(*run_with("doze").first / "out/units/faulty/dozes") == "now");
  const std::string log = run_with("print").second;
  const std::string machine = serve_command().substr(5);
  CHECK_THAT(log, Contains("unit 'faulty' printed: (" + machine + ") line     0: ....") &&
                      Contains("(" + machine + ") line 16383: ...."));
}

TEST_CASE("stride serve is not for terminals and not for other peers") {
  const Outcome outcome = run_program({"serve", "--only", "no_such.fmu"});
  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Contains("there is no unit 'no_such.fmu'"));
}

TEST_CASE("--at and --capture take the names of components that hold a '='") {
  Parts parts = two_filters();
  parts.components = component("a=b", "minimal.fmu") + component("a=c", "minimal.fmu");
  parts.connections = connection("a=b.y", "a=c.u");
  const Workspace workspace(parts);
  Arguments options{"--stop", "0.5", "--quiet", "--capture", "a=c=seen.csv"};
  options.insert(options.end(), {"--at", "a=c=" + serve_command()});
  CHECK(workspace.run(options).exit_code == 0);
  CHECK(host_entry(workspace, 0).is_null());
  CHECK(host_entry(workspace, 1).contains("machine"));
  CHECK(fs::exists(workspace / "seen.csv"));
  CHECK(workspace.run({"--stop", "0.5", "--quiet", "--at", "a=*=" + serve_command()}).exit_code ==
        0);
  CHECK(host_entry(workspace, 0).contains("machine"));
}
