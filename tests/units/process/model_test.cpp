// The protocol from the unit's side, with programs of a few lines.
#include "units/process/model.h"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/scratch_folder.h"
#include "tests/units/process/program.h"

using namespace process;
using Catch::Contains;
using stride::Duration;
using stride::Time;
using stride::tests::answer;
using stride::tests::ScratchFolder;
using stride::tests::shell;

namespace {

Variable variable(const std::string& name, Role role, const Value& start) {
  Variable made;
  made.name = name;
  made.role = role;
  made.start = start;
  return made;
}

enum Place { kGain, kU, kText, kY, kN, kIn, kOut };

Declaration example() {
  Declaration d;
  d.variables = {variable("gain", Role::Parameter, 2.5),
                 variable("u", Role::Input, 0.1),
                 variable("text", Role::Input, std::string("a & b")),
                 variable("y", Role::Output, 0.0),
                 variable("n", Role::Output, std::int8_t{0}),
                 variable("in", Role::MessageInput, Binary()),
                 variable("out", Role::MessageOutput, std::string())};
  return d;
}

Time at(std::int64_t picoseconds) { return Time(Duration(picoseconds)); }

struct Play {
  explicit Play(const std::vector<std::string>& command, Declaration declared = example())
      : declaration(std::move(declared)) {
    for (const Variable& each : declaration.variables) values.push_back(each.start);
    session.emplace(declaration, values, command, Limits{},
                    [this](bool is_warning, const std::string& text) {
                      log.push_back((is_warning ? "warning: " : "info: ") + text);
                    });
  }
  Sync start(Time time = {}) { return session->start({"it", "/r", "", ""}, time); }

  Declaration declaration;
  std::vector<Value> values;
  std::vector<std::string> log;
  std::optional<Session> session;
};

constexpr const char* kOutputs =
    "<output name=\"y\" value=\"1\"/>\n<output name=\"n\" value=\"-3\"/>\n";

std::string started(const std::string& rest = "<sync time=\"0\"/>") {
  return answer("start", kOutputs + rest);
}

/// What the program receives, from one that writes it to a file and answers each step with its end.
std::string told(const std::function<void(Play&)>& play, const Declaration& declaration) {
  const ScratchFolder folder;
  const std::string file = (folder / "told").string();
  const std::string script =
      "t=0; u=1; while read -r line; do printf '%s\\n' \"$line\" >> " + file +
      "; n=${line#*size=\\\"}; n=${n%%\\\"*}; case $line in "
      "'<time-unit'*) old=$u; u=${line#*picoseconds=\\\"}; u=${u%%\\\"*}; t=$((t * old / u));; "
      "'<start'*) t=${line#*time=\\\"}; t=${t%%\\\"*}; "
      "printf '<output name=\"y\" value=\"1\"/>\\n<output name=\"n\" value=\"-3\"/>\\n<sync "
      "time=\"%d\"/>\\n' $t;; "
      "'<step'*) t=$((t + n)); printf '<sync time=\"%d\"/>\\n' $t;; "
      "'<end'*) exit 0;; esac; done";
  Play p(shell(script), declaration);
  play(p);
  p.session->finish();
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("the lines that a program receives, to the letter") {
  const std::string lines = told(
      [](Play& p) {
        p.start(at(5));
        CHECK(p.session->step(at(1005), true).time == at(1005));
        p.values[kU] = -0.0;
        CHECK(p.session->has_news());
        p.session->step(at(1006), false);
        CHECK_FALSE(p.session->has_news());
        p.values[kIn] = Binary{0xde, 0xad};
        p.session->receive(kIn);
        p.session->step(at(1006), false);
      },
      example());
  CHECK(lines ==
        "<open protocol=\"1\" instance=\"it\" resources=\"/r\"/>\n"
        "<parameter name=\"gain\" value=\"2.5\"/>\n"
        "<input name=\"u\" value=\"0.1\"/>\n"
        "<input name=\"text\" value=\"a &amp; b\"/>\n"
        "<start time=\"5\"/>\n"
        "<step size=\"1000\" may-stop=\"true\"/>\n"
        "<input name=\"u\" value=\"-0\"/>\n"
        "<step size=\"1\" may-stop=\"false\"/>\n"
        "<message name=\"in\" time=\"1006\" value=\"dead\"/>\n"
        "<step size=\"0\" may-stop=\"false\"/>\n"
        "<end/>\n");
}

TEST_CASE("a step that is not a multiple of the unit of time is sent in picoseconds") {
  Declaration declaration = example();
  declaration.time_unit = Duration(1000);
  const std::string lines = told(
      [](Play& p) {
        p.start(at(2000));
        p.session->step(at(5000), true);
        p.session->step(at(5001), true);
        p.session->step(at(6000), true);
        p.session->step(at(8000), true);
      },
      declaration);
  CHECK(lines.substr(lines.find("<start")) ==
        "<start time=\"2\"/>\n"
        "<step size=\"3\" may-stop=\"true\"/>\n"
        "<time-unit picoseconds=\"1\"/>\n"
        "<step size=\"1\" may-stop=\"true\"/>\n"
        "<step size=\"999\" may-stop=\"true\"/>\n"
        "<time-unit picoseconds=\"1000\"/>\n"
        "<step size=\"2\" may-stop=\"true\"/>\n"
        "<end/>\n");
  CHECK_THAT(lines, Contains("resources=\"/r\"/>\n<time-unit picoseconds=\"1000\"/>\n"));
}

TEST_CASE("what a program answers") {
  Play p(shell(
      started("<log level=\"warning\" text=\"hot\"/>\n<time-unit picoseconds=\"10\"/>\n"
              "<sync time=\"0\" next=\"7\"/>") +
      answer("step",
             "<message name=\"out\" time=\"30\" value=\"a\"/>\n"
             "<output name=\"n\" value=\"5\"/>\n"
             "<message name=\"out\" time=\"30\" value=\"b\"/>\n<sync time=\"30\" end=\"true\"/>") +
      "read -r last"));
  const Sync begin = p.start();
  CHECK(begin.next == at(70));
  CHECK_FALSE(begin.ends);
  CHECK(std::get<double>(p.values[kY]) == 1);
  CHECK(std::get<std::int8_t>(p.values[kN]) == -3);
  CHECK(p.log == std::vector<std::string>{"warning: hot"});

  const Sync sync = p.session->step(at(100), true);
  CHECK(sync.time == at(30));
  CHECK_FALSE(sync.next);
  CHECK(sync.ends);
  CHECK(std::get<double>(p.values[kY]) == 1);  // what has not changed need not be told
  CHECK(std::get<std::int8_t>(p.values[kN]) == 5);
  REQUIRE(p.session->sent().size() == 2);
  CHECK(std::get<std::string>(p.session->sent()[1].value) == "b");
  CHECK(p.session->sent()[1].time == at(30));
}

TEST_CASE("wrong answers are named and quoted, with what was expected") {
  const auto [line, expected] = GENERATE(table<std::string, std::string>({
      {"hello", "wrote as line 4 'hello': column 1: expected '<'"},
      {"<output name=\"y\" value=\"1\"", "column 27: expected a blank or '/>'"},
      {"<put/>", "<put> is not known: expected <output>, <message>"},
      {"<output name=\"z\" value=\"1\"/>", "'z' is not an output; declared are 'y', 'n'"},
      {"<output name=\"u\" value=\"1\"/>", "'u' is not an output, but an input"},
      {"<output name=\"out\" value=\"1\"/>", "'out' is not an output, but a message output"},
      {"<output name=\"y\"/>", "expected the attribute 'value'"},
      {"<output name=\"y\" value=\"1\" unit=\"m\"/>", "unknown attribute 'unit'"},
      {"<output name=\"y\" value=\"one\"/>", "'one' is not a valid Float64; expected a number"},
      {"<output name=\"n\" value=\"200\"/>", "'200' is not a valid Int8"},
      {"<message name=\"in\" time=\"0\" value=\"\"/>",
       "'in' is not a message output, but a message input"},
      {"<message name=\"out\" value=\"a\"/>", "expected the attribute 'time'"},
      {"<message name=\"out\" time=\"11\" value=\"a\"/>",
       "expected in the order of time, from 0 s to 1e-11 s"},
      {"<message name=\"out\" time=\"5\" value=\"a\"/>\n<message name=\"out\" time=\"4\" "
       "value=\"a\"/>",
       "expected in the order of time, from 5e-12 s to 1e-11 s"},
      {"<message name=\"out\" time=\"5\" value=\"a\"/>\n<sync time=\"4\"/>",
       "expected from 5e-12 s to 1e-11 s"},
      {"<log level=\"loud\" text=\"a\"/>", "expected info or warning"},
      {"<time-unit picoseconds=\"0\"/>", "expected at least one picosecond"},
      {"<sync time=\"11\"/>", "the step ended at 1.1e-11 s, expected from 0 s to 1e-11 s"},
      {"<sync time=\"-1\"/>", "the step ended at -1e-12 s, expected from 0 s to 1e-11 s"},
      {"<sync time=\"0.5\"/>", "'0.5' is not a valid Int64; expected a whole number"},
      {"<time-unit picoseconds=\"1000000\"/>\n<sync time=\"9223372036854775807000\"/>",
       "expected a time within 1e15 s"},
      {"<sync time=\"10\" next=\"10\"/>", "next: expected an instant behind 1e-11 s"},
      {"<sync time=\"10\" end=\"yes\"/>", "'yes' is not a valid Boolean"},
      {"<error text=\"out of coffee\"/>", "fails: out of coffee"},
  }));
  Play p(shell(started() + answer("step", line) + "read -r last"));
  p.start();
  CHECK_THROWS_WITH(p.session->step(at(10), true),
                    Contains("the program 'sh -c' ") && Contains(expected));
}

TEST_CASE("a program that must not stop") {
  Play p(shell(started() + answer("step", "<sync time=\"9\"/>") + "read -r last"));
  p.start();
  CHECK_THROWS_WITH(p.session->step(at(10), false),
                    Contains("expected 1e-11 s, where the command required it to end"));
}

TEST_CASE("all outputs are sent at the start") {
  Play p(shell(answer("start", "<output name=\"n\" value=\"1\"/>\n<sync time=\"0\"/>") +
               "read -r last"));
  CHECK_THROWS_WITH(p.start(),
                    Contains("has not sent the outputs 'y' before it answered <start/>"));
}

TEST_CASE("a text that XML cannot hold is refused with the name of its variable") {
  Play p(shell(started() + "read -r last"));
  p.values[kText] = std::string("a\x01");
  CHECK_THROWS_WITH(p.start(), Contains("'text': this text cannot be written in XML"));
}
