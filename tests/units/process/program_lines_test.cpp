// Lines to and from a program, and what may go wrong with them.
#include "units/process/program_lines.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/units/process/program.h"

using namespace std::chrono_literals;
using Catch::Contains;
using process::Limits;
using process::ProgramLines;
using stride::tests::shell;

namespace {

struct Heard {
  std::vector<std::string> lines;
  ProgramLines::Listener listener() {
    return [this](const std::string& line) { lines.push_back(line); };
  }
};

void send(ProgramLines& lines, const std::string& text) {
  lines.commands() += text;
  lines.send("answer");
}

}  // namespace

TEST_CASE("a line there, a line back; blank ones and line ends of other systems do not matter") {
  ProgramLines echo(shell("exec cat"), {}, {});
  for (int i = 0; i < 100; ++i) {
    const std::string line = "<line number=\"" + std::to_string(i) + "\"/>";
    send(echo, "\n  \n" + line + "\r\n");
    REQUIRE(echo.next_line() == line);
  }
  echo.finish();
}

TEST_CASE("neither side waits for the other while both write much") {
  ProgramLines echo(shell("exec cat"), {}, {});
  const std::string line(std::size_t{3} << 20, 'x');
  send(echo, line + "\n" + line + "\n");
  CHECK(echo.next_line() == line);
  CHECK(echo.next_line() == line);
}

TEST_CASE("standard error is read, and quoted where the program fails") {
  Heard heard;
  ProgramLines program(shell("for i in 1 2 3 4 5 6 7 8 9 10 11 12; do echo \"note $i\" >&2; done; "
                             "printf cut >&2; exit 7"),
                       {}, heard.listener());
  program.send("start");
  CHECK_THROWS_WITH(
      program.next_line(),
      Contains("the program 'sh -c' ended with the exit code 7 while it was to start") &&
          Contains("its last lines on standard error:\n    note 3\n") &&
          Contains("note 12\n    cut"));
  CHECK(heard.lines.size() == 12);
  CHECK(heard.lines.front() == "note 1");
}

TEST_CASE("a program that is killed, or ends in the midst of a line") {
  ProgramLines killed(shell("kill -ABRT $$"), {}, {});
  killed.send("make a step");
  CHECK_THROWS_WITH(killed.next_line(),
                    Contains("was killed by signal 6 (SIGABRT) while it was to make a step"));
  ProgramLines torn(shell("printf '<sync ti'"), {}, {});
  torn.send("make a step");
  CHECK_THROWS_WITH(torn.next_line(), Contains("ended with the exit code 0") &&
                                          Contains("its last line is cut off: '<sync ti'"));
}

TEST_CASE("a program that closes its output, or its input") {
  ProgramLines mute(shell("exec >&-; exec sleep 1000"), {}, {});
  mute.send("start");
  CHECK_THROWS_WITH(mute.next_line(),
                    Contains("has closed its standard output while it was to start"));
  ProgramLines deaf(shell("exec <&-; echo ready; sleep 0.1; exit 4"), {}, {});
  REQUIRE(deaf.next_line() == "ready");
  for (int i = 0; i < 3; ++i) send(deaf, "<step/>\n");
  CHECK_THROWS_WITH(deaf.next_line(), Contains("ended with the exit code 4"));
}

TEST_CASE("a program that falls silent is ended") {
  ProgramLines silent(shell("exec sleep 1000"), {50ms, 1000}, {});
  silent.send("make a step");
  CHECK_THROWS_WITH(silent.next_line(),
                    Contains("wrote nothing for 50 ms while it was to make a step") &&
                        Contains("process.time_limit"));
}

TEST_CASE("a program that writes without end is ended") {
  const std::string script =
      GENERATE(as<std::string>(), "yes '<output/>'", "yes x | tr -d '\\n'", "yes error >&2");
  ProgramLines endless(shell(script), {60s, 1 << 20}, {});
  endless.send("start");
  CHECK_THROWS_WITH(
      [&] {
        while (true) endless.next_line();
      }(),
      Contains("has written more than 1048576 bytes while it was to start") &&
          Contains("process.answer_limit"));
}

TEST_CASE("a line with a mistake is named and quoted") {
  ProgramLines program(shell("echo one; echo; echo '<three>'; exec cat"), {}, {});
  program.send("start");
  program.next_line();
  program.next_line();
  CHECK_THROWS_WITH(program.fail_line("expected four"),
                    Contains("the program 'sh -c' wrote as line 3 '<three>': expected four"));
}

TEST_CASE("what is not text is quoted as far as it is") {
  Heard heard;
  ProgramLines program(
      shell("printf 'a\\377\\033[1mb\\n' >&2; sleep 0.05; printf '\\342\\202<\\n'"), {},
      heard.listener());
  program.send("start");
  program.next_line();
  CHECK_THROWS_WITH(program.fail_line("no"), Contains("'\uFFFD\uFFFD<': no"));
  CHECK(heard.lines == std::vector<std::string>{"a\uFFFD\uFFFD[1mb"});
}

TEST_CASE("a program may write until it ends, more than a pipe holds") {
  ProgramLines program(shell("cat > /dev/null; yes line | head -n 100000; echo last"), {}, {});
  program.commands() = "<end/>\n";
  program.finish();
  std::size_t count = 0;
  std::string last;
  while (const auto line = program.next_last_line()) {
    ++count;
    last = *line;
  }
  CHECK(count == 100001);
  CHECK(last == "last");
}

TEST_CASE("the end is waited for, and has to be a good one") {
  ProgramLines good(shell("cat > /dev/null; echo late >&2; sleep 0.05"), {}, {});
  good.commands() = "<end/>\n";
  CHECK_NOTHROW(good.finish());
  CHECK_NOTHROW(good.require_success());
  ProgramLines bad(shell("cat > /dev/null; echo sorry >&2; exit 2"), {}, {});
  bad.finish();
  CHECK_THROWS_WITH(bad.require_success(), Contains("ended with the exit code 2 at the end of the "
                                                    "run; expected the exit code 0") &&
                                               Contains("sorry"));
  ProgramLines stubborn(shell("exec sleep 1000"), {50ms, 1000}, {});
  CHECK_THROWS_WITH(stubborn.finish(),
                    Contains("received the end command, and has not ended within 50 ms"));
}
