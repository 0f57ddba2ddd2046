// Texts of others cannot control the terminal.
#include "tests/cli/failures.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// An escape sequence, C1 in UTF-8, a carriage return and a text from right to left.
const std::string kHostile =
    "\x1b]0;x\x07\xc2\x9b"
    "31m\r\xe2\x80\xae\xe2\x81\xa6";
const std::string kShown = "\\x1b]0;x\\x07\\u009b31m\\x0d\\u202e\\u2066";

void check_harmless(const std::string& printed) {
  INFO(printed);
  for (const char* piece : {"\x1b", "\x07", "\xc2\x9b", "\r", "\xe2\x80\xae", "\xe2\x81\xa6"}) {
    CHECK(printed.find(piece) == std::string::npos);
  }
}

/// As an attribute of XML has it, without what XML does not allow.
std::string in_xml() {
  return "\xc2\x9b"
         "31m&#13;\xe2\x80\xae\xe2\x81\xa6";
}

}  // namespace

TEST_CASE("an error with a hostile name") {
  const Workspace workspace(two_filters());
  for (const Arguments& command : {Arguments{"run", kHostile},
                                   {"check", "test.ssd", "--set", kHostile + ".u=1"},
                                   {"inspect", kHostile},
                                   {kHostile},
                                   {"run", "test.ssd", "--" + kHostile}}) {
    const Outcome outcome = workspace.stride(command);
    CHECK(outcome.exit_code == 2);
    check_harmless(outcome.err);
    CHECK_THAT(outcome.err, Contains(kShown));
  }
}

TEST_CASE("hostile names in a scenario and in a unit") {
  const Workspace workspace(Parts{component("a" + in_xml(), "x") + component("b", "minimal.fmu")});
  make_raw_fmu(workspace.scratch(), "raw");
  fs::rename(workspace / "raw", workspace / "x");
  std::string description = read(workspace / "x/modelDescription.xml");
  description.replace(description.find("modelName=\"test\""), 16, "modelName=\"" + in_xml() + "\"");
  workspace.scratch().write("x/modelDescription.xml", description);
  for (const Arguments& command :
       {Arguments{"check", "test.ssd"}, {"inspect", "x"}, {"run", "test.ssd", "--out", "out"}}) {
    const Outcome outcome = workspace.stride(command);
    check_harmless(outcome.out + outcome.err);
  }
  CHECK_THAT(workspace.stride({"inspect", "x"}).out,
             Contains("\\u009b31m\\x0d\\u202e\\u2066: FMI"));
}

TEST_CASE("what a unit logs, in process and hosted") {
  const Workspace workspace(Parts{component("x", "thrower.fmu")});
  for (const bool is_hosted : {false, true}) {
    Arguments arguments{"--verbose",      "run",   "test.ssd",
                        "--out",          "out",   "--set",
                        "x.throw_at=0.5", "--set", "x.message=" + kHostile};
    if (is_hosted) arguments.push_back("--isolate");
    const Outcome outcome = workspace.stride(arguments);
    CHECK(outcome.exit_code == 1);
    check_harmless(outcome.out + outcome.err);
    CHECK_THAT(outcome.err, Contains(kShown));
    CHECK(run_json(workspace)["error"].get<std::string>().find(kHostile) != std::string::npos);
  }
}

TEST_CASE("what is quoted makes no message of its own") {
  const std::string forged = "a\nstride: error: the disk is broken";
  Workspace workspace(two_filters());
  for (const Arguments& command : {Arguments{"run", forged},
                                   {"check", "test.ssd", "--set", forged + ".u=1"},
                                   {"check", "test.ssd", "--set", "first.u=" + forged},
                                   {"inspect", forged},
                                   {forged},
                                   {"check", "test.ssd", forged}}) {
    const Outcome outcome = workspace.stride(command);
    CHECK(outcome.exit_code == 2);
    INFO(outcome.err);
    CHECK(outcome.err.find("the disk is broken") != std::string::npos);
    CHECK(outcome.err.find("\nstride: error") == std::string::npos);
  }
}

TEST_CASE("a message is not as long as what it quotes") {
  const std::string long_name(100'000, 'x');
  const Workspace workspace(Parts{component(long_name, "minimal.fmu")});
  const Outcome outcome = workspace.stride({"check", "test.ssd", "--set", long_name + ".z=1"});
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.size() < 4000);
}
