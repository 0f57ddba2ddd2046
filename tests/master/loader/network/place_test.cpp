#include "master/loader/network/place.h"

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride::remote;

namespace {

using CommandWords = std::vector<std::string>;

std::string mistake(const std::string& text, const std::string& program = "") {
  return stride::tests::error_of([&] { parse_place(text, program); });
}

}  // namespace

TEST_CASE("a machine is reached by ssh, which asks for nothing") {
  const Place place = parse_place("ssh://me@box:2222");
  CHECK(place.command == CommandWords{"ssh", "-T", "-o", "BatchMode=yes", "-p", "2222", "-l", "me",
                                      "--", "box", "stride serve"});
  CHECK(place.machine == "me@box (port 2222)");
  CHECK(parse_place("ssh://box/").command ==
        CommandWords{"ssh", "-T", "-o", "BatchMode=yes", "--", "box", "stride serve"});
  CHECK(parse_place("ssh://[fe80::1%eth0]:22").command ==
        CommandWords{"ssh", "-T", "-o", "BatchMode=yes", "-p", "22", "--", "fe80::1%eth0",
                     "stride serve"});
}

TEST_CASE("the program there is one word of its shell") {
  CHECK(parse_place("ssh://box", "/opt/my stride/bin/stride").command.back() ==
        "'/opt/my stride/bin/stride' serve");
  CHECK(parse_place("ssh://box", "a;reboot").command.back() == "'a;reboot' serve");
}

TEST_CASE("a command is run by the shell of this machine") {
  const Place place = parse_place("exec:srun -n1 stride serve --only 'a b.fmu'");
  CHECK(place.command == CommandWords{"/bin/sh", "-c", "srun -n1 stride serve --only 'a b.fmu'"});
}

TEST_CASE("nothing that a user writes becomes an option of ssh") {
  for (const char* text : {"ssh://-oProxyCommand=reboot",
                           "ssh://-x@box",
                           "ssh://me@-box",
                           "ssh://[-x]",
                           "ssh://box;reboot",
                           "ssh://a b",
                           "ssh://",
                           "ssh://@box",
                           "ssh://me@",
                           "ssh://box:",
                           "ssh://box:0",
                           "ssh://box:65536",
                           "ssh://box:22x",
                           "ssh://[::1",
                           "ssh://[::1]x",
                           "ssh://[::1]:",
                           "ssh://box/folder",
                           "ssh://$(reboot)",
                           "ssh://box\n",
                           "box",
                           "",
                           "http://box",
                           "exec:",
                           "exec: \t"}) {
    INFO(text);
    CHECK_THROWS_AS(parse_place(text), std::invalid_argument);
  }
  CHECK_THAT(mistake("ssh://-x"),
             Catch::Matchers::Equals("'ssh://-x' is no place for a unit: '-x' is no name of a "
                                     "machine; expected ssh://[user@]machine[:port], or "
                                     "exec:COMMAND"));
  CHECK_THAT(mistake("exec:stride serve", "/opt/stride"),
             Catch::Matchers::Contains("it belongs into the command"));
}
