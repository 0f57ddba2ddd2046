// A run that goes on from a checkpoint, as if it had not ended.
#include <csignal>
#include <fstream>
#include <map>
#include <random>

#include <nlohmann/json.hpp>

#include "tests/cli/course.h"
#include "tests/cli/failures.h"

using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

std::vector<fs::path> checkpoints(const Workspace& workspace) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(workspace / "out/checkpoints")) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The run as a whole, then with checkpoints, then from each of these.
void check_resumption(const Parts& parts, const Arguments& options, const Arguments& instants) {
  const Workspace whole(parts);
  const Workspace cut(parts);
  const Outcome first = whole.run(options);
  INFO(first.err);
  REQUIRE(first.exit_code == 0);
  Arguments arguments = options;
  for (const std::string& instant : instants) {
    arguments.insert(arguments.end(), {"--checkpoint", instant});
  }
  const Outcome second = cut.run(arguments);
  INFO(second.err);
  REQUIRE(second.exit_code == 0);
  check_same_results(whole / "out", cut / "out");
  const std::vector<fs::path> files = checkpoints(cut);
  REQUIRE(files.size() == instants.size());
  for (const fs::path& file : files) {
    CAPTURE(file.string());
    const Outcome resumed = cut.stride({"resume", file.string(), "--quiet"});
    INFO(resumed.err);
    REQUIRE(resumed.exit_code == 0);
    check_same_results(whole / "out", cut / "out");
    const Outcome elsewhere = cut.stride({"resume", file.string(), "--out", "elsewhere"});
    INFO(elsewhere.err);
    REQUIRE(elsewhere.exit_code == 0);
    check_same_results(whole / "out", cut / "elsewhere");
  }
  CHECK(cut.left_behind().empty());
}

Parts plain_parts(const std::string& annotation = "") {
  return {component("a", "minimal.fmu") + component("b", "minimal.fmu"), connection("a.y", "b.u"),
          annotation};
}

/// A ticker that ticks each 0.141 s, and who listens to it.
Parts ticking_parts(const std::string& annotation = "") {
  return {component("ticker", "ticker.fmu") + component("listener", "listener.fmu"),
          connection("ticker.tick.clock", "listener.message.clock") +
              connection("ticker.tick.number", "listener.message.number") +
              connection("ticker.tick.picoseconds", "listener.message.picoseconds"),
          annotation};
}

}  // namespace

TEST_CASE("a run goes on from a checkpoint to the same results") {
  check_resumption(plain_parts(), {"--quiet", "--set", "a.u=1"}, {"0", "0.25", "0.7501", "1"});
}

TEST_CASE("a run goes on before and behind the picoseconds that 64 bits can count") {
  check_resumption(ticking_parts(), {"--quiet", "--start", "9223371", "--stop", "9223373"},
                   {"9223371.5", "9223372.036854775808", "9223372.5"});
}

TEST_CASE("a run that begins before 0 s goes on") {
  check_resumption(ticking_parts(), {"--start", "-0.5", "--stop", "0.5", "--quiet"},
                   {"-0.25", "0.3"});
}

TEST_CASE("a run goes on in the middle of interventions") {
  check_resumption(plain_parts(),
                   {"--quiet", "--set", "a.u=1", "--set-at", "a.u=3@0.4142", "--force",
                    "b.u@0.31..0.62", "--force", "b.u=5@0.7..0.8"},
                   {"0.31", "0.4", "0.5", "0.75", "0.9"});
}

TEST_CASE("a run goes on with messages that are on their way") {
  check_resumption(ticking_parts(),
                   {"--quiet", "--delay", "listener.message.number=0.1@0.2..0.6", "--drop",
                    "listener.message.number@0.7..0.9"},
                   {"0.141", "0.15", "0.3", "0.43", "0.75", "0.99"});
}

TEST_CASE("a run goes on with extrapolated inputs, sequential steps and error control") {
  check_resumption(plain_parts(),
                   {"--quiet", "--set", "a.u=1", "--extrapolation", "quadratic", "--step", "0.02"},
                   {"0.02", "0.5"});
  check_resumption(plain_parts(), {"--quiet", "--set", "a.u=1", "--coupling", "gauss-seidel"},
                   {"0.5"});
  check_resumption(
      plain_parts(),
      {"--quiet", "--set", "a.u=1", "--policy", "error-controlled", "--extrapolation", "linear"},
      {"0.1", "0.5"});
}

TEST_CASE("a run goes on with its checks to the same verdicts and margins") {
  const std::string checks =
      "<stride:Checks>"
      "<stride:Always name='low' signal='ticker.level' max='2.5' from='0.1'/>"
      "<stride:Eventually name='high' signal='ticker.level' min='3'/>"
      "<stride:Count name='ticks' event='ticker.tick.number' min='3' max='10'/>"
      "<stride:Answer name='heard' request='ticker.tick.number' reply='listener.message.number' "
      "within='0.01'/>"
      "<stride:Answer name='late' request='ticker.tick.number' reply='listener.message.number' "
      "within='0' repeats='true' from='0.2'/></stride:Checks>";
  const Workspace whole(ticking_parts(checks));
  const Workspace cut(ticking_parts(checks));
  const Arguments options{"--quiet", "--set", "ticker.period=0.1", "--delay",
                          "listener.message.clock=0.02@0.5..0.6"};
  CHECK(whole.run(options).exit_code == 1);
  Arguments arguments = options;
  for (const char* instant : {"0", "0.15", "0.51", "0.8", "1"}) {
    arguments.insert(arguments.end(), {"--checkpoint", instant});
  }
  CHECK(cut.run(arguments).exit_code == 1);
  const auto expected = run_json(whole)["checks"];
  REQUIRE(expected.size() == 5);
  for (const auto& check : expected) CHECK(check["margin"].is_object());
  CHECK(expected[3]["margin"]["value"] == -0.01);
  REQUIRE(checkpoints(cut).size() == 5);
  for (const fs::path& file : checkpoints(cut)) {
    CAPTURE(file.string());
    CHECK(cut.stride({"resume", file.string(), "--quiet"}).exit_code == 1);
    CHECK(run_json(cut)["checks"] == expected);
  }
}

TEST_CASE("a run with units in processes of their own goes on") {
  check_resumption(ticking_parts(), {"--quiet", "--isolate"}, {"0.2", "0.5"});
  check_resumption(plain_parts(), {"--quiet", "--set", "a.u=1", "--isolate=b"}, {"0.5"});
}

TEST_CASE("a run on several threads goes on") {
  check_resumption(plain_parts(), {"--quiet", "--set", "a.u=1", "--threads", "2"}, {"0.5"});
}

TEST_CASE("captured stimuli go on, and a copy of them where the results go elsewhere") {
  const Workspace whole(plain_parts());
  const Workspace cut(plain_parts());
  const Arguments options{"--quiet", "--set", "a.u=1", "--capture", "b=stimuli.csv"};
  REQUIRE(whole.run(options).exit_code == 0);
  Arguments arguments = options;
  arguments.insert(arguments.end(), {"--checkpoint", "0.5"});
  REQUIRE(cut.run(arguments).exit_code == 0);
  const std::string stimuli = read(whole / "stimuli.csv");
  CHECK(read(cut / "stimuli.csv") == stimuli);
  REQUIRE(cut.stride({"resume", "out", "--quiet"}).exit_code == 0);
  CHECK(read(cut / "stimuli.csv") == stimuli);
  const Outcome elsewhere =
      cut.stride({"resume", "out", "--quiet", "--out", "elsewhere", "--set-at", "a.u=7@0.75"});
  INFO(elsewhere.err);
  REQUIRE(elsewhere.exit_code == 0);
  CHECK(read(cut / "stimuli.csv") == stimuli);
  const std::string other = read(cut / "elsewhere/stimuli/b.csv");
  const std::size_t place = stimuli.find("0.751,");
  REQUIRE(place != std::string::npos);
  CHECK(other.substr(0, place) == stimuli.substr(0, place));
  CHECK(other != stimuli);
}

TEST_CASE("captures of equal names go on in copies of their own") {
  const Workspace cut(plain_parts());
  fs::create_directory(cut / "folder");
  REQUIRE(cut.run({"--quiet", "--set", "a.u=1", "--checkpoint", "0.5", "--capture", "a=signals.csv",
                   "--capture", "b=folder/signals.csv"})
              .exit_code == 0);
  const Outcome outcome = cut.stride({"resume", "out", "--quiet", "--out", "elsewhere"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(read(cut / "elsewhere/stimuli/a.csv") == read(cut / "signals.csv"));
  CHECK(read(cut / "elsewhere/stimuli/b.csv") == read(cut / "folder/signals.csv"));
  CHECK(read(cut / "elsewhere/signals.csv") == cut.result("signals.csv"));
}

TEST_CASE("a run that cannot be resumed leaves all results as they were") {
  const Workspace cut(ticking_parts());
  REQUIRE(
      cut.run({"--quiet", "--checkpoint", "0.5", "--capture", "listener=stimuli.csv"}).exit_code ==
      0);
  const std::string damaged = GENERATE("signals.csv", "events.csv", "signals.vcd", "activity.csv");
  CAPTURE(damaged);
  std::string text = cut.result(damaged);
  text[text.find_first_of("0123456789", 30)] ^= 1;
  std::ofstream(cut / "out" / damaged, std::ios::binary | std::ios::trunc) << text;
  std::map<std::string, std::string> before{{"stimuli", read(cut / "stimuli.csv")}};
  for (const char* const file : kTraces) before[file] = cut.result(file);
  for (const char* const file : {"run.json", "report.html"}) before[file] = cut.result(file);
  CHECK_THAT(input_error_of(cut.stride({"resume", "out"})),
             Contains(damaged + ": the file is not the one that the run had written"));
  for (const auto& [file, content] : before) {
    CAPTURE(file);
    CHECK(content == (file == "stimuli" ? read(cut / "stimuli.csv") : cut.result(file)));
  }
}

TEST_CASE("a run can go on for longer than it was meant to") {
  const Workspace whole(plain_parts());
  const Workspace cut(plain_parts());
  REQUIRE(whole.run({"--quiet", "--set", "a.u=1", "--stop", "2"}).exit_code == 0);
  REQUIRE(cut.run({"--quiet", "--set", "a.u=1", "--checkpoint", "1"}).exit_code == 0);
  const Outcome outcome = cut.stride({"resume", "out", "--stop", "2", "--quiet"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  check_same_results(whole / "out", cut / "out");
}

TEST_CASE("a run goes on with other interventions, as one that has had them from the beginning") {
  const Workspace whole(plain_parts());
  const Workspace cut(plain_parts());
  const Arguments intervention{"--set-at", "a.u=7@0.75", "--force", "b.u=1@0.8.."};
  Arguments arguments{"--quiet", "--set", "a.u=1"};
  REQUIRE(cut.run({"--quiet", "--set", "a.u=1", "--checkpoint", "0.5"}).exit_code == 0);
  arguments.insert(arguments.end(), intervention.begin(), intervention.end());
  REQUIRE(whole.run(arguments).exit_code == 0);
  Arguments resume{"resume", "out", "--quiet", "--out", "other"};
  resume.insert(resume.end(), intervention.begin(), intervention.end());
  REQUIRE(cut.stride(resume).exit_code == 0);
  check_same_results(whole / "out", cut / "other");

  const Outcome late = cut.stride({"resume", "out", "--set-at", "a.u=7@0.25", "--out", "late"});
  CHECK(late.exit_code == 2);
  CHECK_THAT(late.err, Contains("an intervention begins at or before 0.5 s"));
}

TEST_CASE("a run is not resumed to end before its checkpoint") {
  const Workspace cut(plain_parts());
  REQUIRE(cut.run({"--quiet", "--checkpoint", "0.5"}).exit_code == 0);
  const std::string results = cut.result("signals.csv");
  CHECK_THAT(input_error_of(cut.stride({"resume", "out", "--stop", "0.25"})),
             Contains("the checkpoint is at 0.5 s, and the run is from 0 s to 0.25 s"));
  CHECK(cut.result("signals.csv") == results);
}

TEST_CASE("a resumed run is resumed again, with all that it was given") {
  const Workspace whole(plain_parts());
  const Workspace cut(plain_parts());
  REQUIRE(
      whole.run({"--quiet", "--set", "a.u=1", "--set-at", "a.u=7@0.5", "--stop", "2"}).exit_code ==
      0);
  REQUIRE(cut.run({"--quiet", "--set", "a.u=1", "--checkpoint", "0.25"}).exit_code == 0);
  const Outcome first = cut.stride(
      {"resume", "out", "--quiet", "--set-at", "a.u=7@0.5", "--stop", "2", "--checkpoint", "1.5"});
  INFO(first.err);
  REQUIRE(first.exit_code == 0);
  const Outcome second = cut.stride({"resume", "out", "--quiet"});
  INFO(second.err);
  REQUIRE(second.exit_code == 0);
  check_same_results(whole / "out", cut / "out");
}

TEST_CASE("other signals are recorded from the checkpoint on") {
  const Workspace cut(plain_parts());
  REQUIRE(
      cut.run({"--quiet", "--set", "a.u=1", "--signals", "b.y", "--checkpoint", "0.5"}).exit_code ==
      0);
  const Outcome same = cut.stride({"resume", "out", "--signals", "*", "--quiet"});
  CHECK(same.exit_code == 2);
  CHECK_THAT(same.err, Contains("--out FOLDER"));
  REQUIRE(cut.stride({"resume", "out", "--signals", "*", "--quiet", "--out", "more"}).exit_code ==
          0);
  const Csv more(cut / "more/signals.csv");
  CHECK(more.has("a.y"));
  CHECK(more.row(0)[0] == "0.501");
  CHECK(more.numbers("b.y").back() == cut.signals().numbers("b.y").back());
}

TEST_CASE("the table of a resumed run says since when it knows a signal") {
  const Workspace cut(plain_parts());
  const Arguments plain{"--progress", "none", "--set", "a.u=1", "--checkpoint", "0.5"};
  const auto table_of = [](const std::string& out) {
    const std::size_t begin = out.find("\nSignals\n");
    return out.substr(begin, out.find("\nUnits\n") - begin);
  };
  const Outcome whole = cut.run(plain);
  REQUIRE(whole.exit_code == 0);
  const Outcome same = cut.stride({"resume", "out", "--progress", "none"});
  INFO(same.err);
  CHECK(table_of(same.out) == table_of(whole.out));
  const Outcome more =
      cut.stride({"resume", "out", "--progress", "none", "--signals", "*", "--out", "more"});
  INFO(more.err);
  CHECK(more.exit_code == 0);
  CHECK_THAT(more.out, Contains("a.u *") && Contains("* least and most since 0.5 s"));

  Arguments quiet = plain;
  quiet.push_back("--quiet");
  REQUIRE(cut.run(quiet).exit_code == 0);
  const Outcome late = cut.stride({"resume", "out", "--progress", "none"});
  INFO(late.err);
  CHECK(late.exit_code == 0);
  CHECK_THAT(late.out, Contains("a.y *") && Contains("* least and most since 0.5 s"));
}

TEST_CASE("what has changed since the checkpoint is named") {
  const Workspace cut(plain_parts());
  REQUIRE(cut.run({"--quiet", "--checkpoint", "0.5"}).exit_code == 0);
  const std::string results = cut.result("signals.csv");
  std::ofstream(cut / "test.ssd", std::ios::app) << "<!-- changed -->\n";
  const Outcome outcome = cut.stride({"resume", "out"});
  CHECK_THAT(input_error_of(outcome),
             Contains("the checkpoint is of another run: the scenario, ") &&
                 Contains("test.ssd, is not what it was"));
  CHECK(cut.result("signals.csv") == results);
}

TEST_CASE("files of parameters are among what a run was made from") {
  const Workspace cut(plain_parts());
  const auto write_gain = [&](const std::string& file, const std::string& value) {
    cut.scratch().write(
        file,
        "<ssv:ParameterSet xmlns:ssv='http://ssp-standard.org/SSP1/SystemStructureParameterValues' "
        "version='1.0' name='p'><ssv:Parameters><ssv:Parameter name='a.u'><ssv:Real value='" +
            value + "'/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>");
  };
  fs::create_directory(cut / "other");
  write_gain("p.ssv", "1");
  write_gain("other/p.ssv", "2");
  REQUIRE(cut.run({"--quiet", "--checkpoint", "0.5", "--parameters", "p.ssv", "--parameters",
                   "other/p.ssv"})
              .exit_code == 0);
  const auto run = nlohmann::json::parse(cut.result("run.json"));
  std::vector<std::string> found;
  for (const auto& source : run["provenance"]["sources"]) {
    if (source["what"] == "a file of parameters") found.push_back(source["path"]);
  }
  const fs::path folder = fs::canonical(cut / "test.ssd").parent_path();
  CHECK(found == std::vector<std::string>{folder / "p.ssv", folder / "other/p.ssv"});
  CHECK(cut.stride({"resume", "out", "--quiet"}).exit_code == 0);
  write_gain("other/p.ssv", "3");
  CHECK_THAT(input_error_of(cut.stride({"resume", "out"})),
             Contains("a file of parameters, ") && Contains("other/p.ssv, is not what it was"));
  for (const Arguments& output : {Arguments{"--junit", "p.ssv"}, {"--capture", "a=p.ssv"}}) {
    Arguments words{"--parameters", "p.ssv"};
    words.insert(words.end(), output.begin(), output.end());
    CHECK_THAT(input_error_of(cut.run(words)), Contains("p.ssv: this is a file of parameters"));
  }
}

TEST_CASE("a folder without checkpoints, a file that is none and missing results are errors") {
  const Workspace cut(plain_parts());
  REQUIRE(cut.run({"--quiet"}).exit_code == 0);
  CHECK_THAT(input_error_of(cut.stride({"resume", "out"})),
             Contains("no checkpoint in this folder of results") && Contains("--checkpoint-every"));
  CHECK_THAT(input_error_of(cut.stride({"resume", "test.ssd"})), Contains("is not a zip archive"));
  CHECK_THAT(input_error_of(cut.stride({"resume", "nothing.zip"})), Contains("nothing.zip"));
  REQUIRE(cut.run({"--quiet", "--checkpoint", "0.5"}).exit_code == 0);
  fs::remove(cut / "out/events.csv");
  CHECK_THAT(input_error_of(cut.stride({"resume", "out"})),
             Contains("events.csv: cannot write on in this file"));
  CHECK_THAT(input_error_of(cut.run({"--checkpoint", "7"})),
             Contains("--checkpoint 7: the run is from 0 s to 1 s"));
  CHECK_THAT(input_error_of(cut.run({"--checkpoint-every", "0"})), Contains("above 0"));
  CHECK_THAT(input_error_of(cut.run({"--checkpoint", "soon"})), Contains("--checkpoint soon"));
}

TEST_CASE("a checkpoint of a unit with clocks of all kinds goes on") {
  const Workspace whole({component("c", "clocks.fmu"), ""});
  const Workspace cut({component("c", "clocks.fmu"), ""});
  const Arguments options{"--quiet", "--stop", "0.1", "--signals", "*"};
  REQUIRE(whole.run(options).exit_code == 0);
  Arguments arguments = options;
  arguments.insert(arguments.end(), {"--checkpoint", "0.05"});
  REQUIRE(cut.run(arguments).exit_code == 0);
  const Outcome outcome = cut.stride({"resume", "out", "--quiet"});
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  check_same_results(whole / "out", cut / "out");
}

TEST_CASE("a run whose unit cannot go on leaves what is in another folder") {
  const Workspace cut({component("c", "fmi2_types.fmu"), ""});
  const Outcome first = cut.run({"--quiet", "--checkpoint", "0.5"});
  INFO(first.err);
  REQUIRE(first.exit_code == 0);
  REQUIRE(cut.stride({"run", "minimal.fmu", "--quiet", "--stop", "1", "--out", "other",
                      "--checkpoint", "0.5"})
              .exit_code == 0);
  const std::string signals = read(cut / "other/signals.csv");
  const Outcome outcome = cut.stride({"resume", "out", "--quiet", "--out", "other"});
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("it cannot be resumed"));
  CHECK(read(cut / "other/signals.csv") == signals);
  CHECK(fs::exists(cut / "other/run.json"));
  CHECK(fs::exists(cut / "other/checkpoints/checkpoint_0.5s.zip"));
  CHECK(cut.stride({"resume", "out", "--quiet", "--out", "new"}).exit_code == 1);
  CHECK_FALSE(fs::exists(cut / "new/signals.csv"));
  CHECK_FALSE(fs::exists(cut / "new/run.json"));
}

TEST_CASE("a resumed run refuses what would lose results or checkpoints") {
  const Workspace cut(plain_parts());
  REQUIRE(cut.run({"--quiet", "--checkpoint", "0.5"}).exit_code == 0);
  const std::string results = cut.result("signals.csv");
  const fs::path file = checkpoints(cut).front();
  const std::string checkpoint = read(file);
  fs::create_directory_symlink("out", cut / "link");
  const auto error = [&](Arguments further) {
    Arguments arguments{"resume", "out", "--quiet"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    const std::string text = input_error_of(cut.stride(arguments));
    CHECK(cut.result("signals.csv") == results);
    CHECK(read(file) == checkpoint);
    return text;
  };
  for (const char* out : {"out", "./out/", "link"}) {
    CHECK_THAT(error({"--signals", "a.y", "--out", out}), Contains("name another folder"));
  }
  CHECK_THAT(error({"--junit", file.string()}), Contains("in the folder 'checkpoints' of the res"));
  CHECK_THAT(error({"--junit", file.string(), "--out", "other"}), Contains("checkpoint"));
  CHECK_THAT(error({"--out", "out/checkpoints"}), Contains("the folder of the checkpoints"));
  CHECK_THAT(error({"--checkpoint", "0.2"}), Contains("--checkpoint 0.2: the run goes on at 0.5"));
  CHECK_THAT(input_error_of(cut.stride({"resume", ""})), Contains("is empty"));
  CHECK_THAT(input_error_of(cut.run(
                 {"--checkpoint", "0.5", "--junit", "out/checkpoints/checkpoint_0.5s.zip"})),
             Contains("in the folder 'checkpoints' of the results"));
}

TEST_CASE("a damaged checkpoint is an error, and the results stay what they are") {
  const Workspace cut(ticking_parts());
  REQUIRE(cut.run({"--quiet", "--checkpoint", "0.5"}).exit_code == 0);
  const fs::path file = checkpoints(cut).front();
  const std::string good = read(file);
  const std::string results = cut.result("signals.csv");
  std::mt19937 random(1);
  int errors = 0;
  for (int i = 0; i < 60; ++i) {
    std::string bad = good;
    if (i % 3 == 0) {
      bad.resize(random() % good.size());
    } else {
      bad[random() % good.size()] ^= static_cast<char>(1 << random() % 8);
    }
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bad;
    const Outcome outcome = cut.stride({"resume", file.string(), "--quiet"});
    INFO(i << ": " << outcome.err);
    // of a zip archive some bytes mean nothing, such as the times of its files
    CHECK((outcome.exit_code == 0 || outcome.exit_code == 2));
    errors += outcome.exit_code == 2;
    CHECK(cut.result("signals.csv") == results);
  }
  CHECK(errors > 40);
}

TEST_CASE("of periodic checkpoints the last two stay, and a new run removes them all") {
  const Workspace cut(plain_parts());
  REQUIRE(cut.run({"--quiet", "--checkpoint-every", "0.1", "--checkpoint", "0.25"}).exit_code == 0);
  std::vector<std::string> names;
  for (const fs::path& file : checkpoints(cut)) names.push_back(file.filename().string());
  CHECK(names ==
        std::vector<std::string>{"checkpoint_0.25s.zip", "latest_0.9s.zip", "latest_1s.zip"});
  REQUIRE(cut.run({"--quiet"}).exit_code == 0);
  CHECK_FALSE(fs::exists(cut / "out/checkpoints"));
}

TEST_CASE("a run that a signal ends goes on from there") {
  Parts parts = ticking_parts();
  parts.experiment = "<ssd:DefaultExperiment stopTime=\"100000\"/>\n";
  const Workspace cut(parts);
  const Arguments arguments = stride_command(Workspace::run_arguments(
      {"--quiet", "--checkpoint-on-signal", "--no-trace", "--step", "0.001"}));
  {
    Process process(arguments, cut.scratch().path());
    await_first_results(process, cut);
    process.send(SIGTERM);
    const Outcome outcome = process.wait();
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.err, Contains("interrupted") && Contains("stride resume out"));
  }
  const std::string last = last_time(cut);
  const std::string stop = std::to_string(std::stod(last) + 5);
  const Outcome resumed = cut.stride({"resume", "out", "--quiet", "--stop", stop});
  INFO(resumed.err);
  REQUIRE(resumed.exit_code == 0);
  const Workspace whole(parts);
  REQUIRE(whole.run({"--quiet", "--no-trace", "--step", "0.001", "--stop", stop}).exit_code == 0);
  const bool is_same = whole.result("signals.csv") == cut.result("signals.csv");
  CHECK(is_same);
}
