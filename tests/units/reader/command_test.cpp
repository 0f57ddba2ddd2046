#include "units/reader/command.h"

#include <stdexcept>

#include <catch2/catch.hpp>

#include "units/reader/program.h"

using nfc::Command;
using reader::ProgramCommand;

namespace {

/// The commands are in line 3.
std::vector<ProgramCommand> parse_all(const std::string& commands) {
  return reader::parse_program(
             "<reader-program version=\"1\">\n<antenna on=\"1\" off=\"9\" power=\"1\"/>\n" +
                 commands + "\n</reader-program>",
             "p.xml")
      .commands;
}

ProgramCommand parse(const std::string& attributes, const std::string& inside = "") {
  const auto commands = parse_all("<command at=\"2\" " + attributes + ">" + inside + "</command>");
  REQUIRE(commands.size() == 1);
  return commands.front();
}

std::string error_of(const std::string& attributes, const std::string& inside = "") {
  try {
    parse(attributes, inside);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

void check_error(const std::string& error, const std::string& element,
                 const std::string& expected) {
  CHECK_THAT(error, Catch::StartsWith("p.xml:3: <" + element + ">: ") && Catch::Contains(expected));
}

}  // namespace

TEST_CASE("Each command of the protocol can be given, with its argument") {
  struct Case {
    const char* attributes;
    Command command;
    nfc::Bytes arguments;
  };
  const Case cases[] = {
      {"name='identify'", Command::Identify, {}},
      {"name='select' identifier='0x0A2B3C4D'", Command::Select, {0x0A, 0x2B, 0x3C, 0x4D}},
      {"name='select' identifier='258'", Command::Select, {0, 0, 1, 2}},
      {"name='read_temperature'", Command::ReadTemperature, {}},
      {"name='read_log'", Command::ReadLog, {}},
      {"name='set_sampling_period' period='258'", Command::SetSamplingPeriod, {1, 2}},
      {"name='set_led' led='on'", Command::SetLed, {1}},
      {"name='set_led' led='off'", Command::SetLed, {0}},
      {"name='sleep'", Command::Sleep, {}},
      {"name='raw' bytes='7f01'", static_cast<Command>(0x7F), {1}},
      {"name='raw' bytes='0302'", Command::SetLed, {2}},
  };
  for (const Case& each : cases) {
    INFO(each.attributes);
    const ProgramCommand command = parse(each.attributes);
    CHECK(command.command == each.command);
    CHECK(command.arguments == each.arguments);
    const int expected = nfc::argument_bytes(each.command);
    if (expected >= 0) CHECK(command.arguments.size() == static_cast<std::size_t>(expected));
  }
}

TEST_CASE("What is not given has its default") {
  const ProgramCommand command = parse("name='identify'");
  CHECK(command.timeout == std::chrono::milliseconds(50));
  CHECK(command.bit_rate == 106);
  CHECK(command.retries == 0);
  CHECK(command.expectation.answer);
  CHECK(command.expectation.status == nfc::Status::Ok);
  const ProgramCommand other =
      parse("name='identify' timeout='0.02' bit_rate='424' retries='3' pause='0.5'");
  CHECK(other.timeout == std::chrono::milliseconds(20));
  CHECK(other.bit_rate == 424);
  CHECK(other.retries == 3);
  CHECK(other.pause == std::chrono::milliseconds(500));
  CHECK(parse("name='identify' retries='3'").pause == std::chrono::milliseconds(10));
}

TEST_CASE("Expectations are read") {
  const auto identify = parse("name='identify'", "<expect identifier='0xFF'/>").expectation;
  CHECK(identify.identifier == 255u);
  const auto range = parse("name='read_temperature'", "<expect lowest='-4.5' highest='30'/>");
  CHECK(range.expectation.lowest == -4.5);
  CHECK(range.expectation.highest == 30.0);
  const auto log = parse("name='read_log'", "<expect samples='3' lowest='20'/>").expectation;
  CHECK(log.samples == 3);
  CHECK(log.lowest == 20.0);
  CHECK_FALSE(log.highest.has_value());
  CHECK_FALSE(parse("name='sleep'", "<expect status='none'/>").expectation.answer);
  CHECK(parse("name='raw' bytes='7F'", "<expect status='unknown_command'/>").expectation.status ==
        nfc::Status::UnknownCommand);
}

TEST_CASE("A mistake in a command is reported with its line") {
  const auto check = [](const std::string& attributes, const std::string& expected) {
    check_error(error_of(attributes), "command", expected);
  };
  check("name='jump'", "'set_sampling_period', 'set_led', 'sleep', 'raw'");
  check("name='identify' led='on'", "unknown attribute 'led'");
  check("name='set_led'", "'led'");
  check("name='set_led' led='1'", "'on' or 'off'");
  check("name='select'", "'identifier'");
  check("name='select' identifier='0x123456789'", "a whole number from 0 to 4294967295");
  check("name='select' identifier='0x'", "a whole number");
  check("name='select' identifier='-1'", "a whole number");
  check("name='set_sampling_period' period='65536'", "a whole number from 0 to 65535");
  check("name='set_sampling_period' period='0.5'", "a whole number");
  for (const char* bytes : {"", "7", "7F0", "7G", "0x7F", "-1"}) {
    check("name='raw' bytes='" + std::string(bytes) + "'", "two hexadecimal digits");
  }
  check("name='raw' bytes='" + std::string(66, '0') + "'", "1 to 32 bytes");
  check("name='identify' timeout='0'", "more than 0 seconds");
  check("name='identify' timeout='3601'", "3600 at most");
  check("name='identify' bit_rate='107'", "106, 212, 424 or 848");
  check("name='identify' retries='-1'", "a whole number from 0 to 1000");
  check("name='identify' retries='1001'", "a whole number from 0 to 1000");
  check("name='identify' retries='1' pause='-0.1'", "pause=\"-0.1\": expected 0 to 3600");
  check("name='identify' pause='0.1'", "expected retries with it");
}

TEST_CASE("A mistake in an expectation is reported with its line") {
  const auto check = [](const std::string& name, const std::string& expectation,
                        const std::string& expected) {
    check_error(error_of("name='" + name + "'", expectation), "expect", expected);
  };
  check("identify", "<expect status='fine'/>",
        "expected one of 'ok', 'unknown_command', 'bad_argument', 'none'");
  check("identify", "<expect lowest='1'/>", "unknown attribute 'lowest'");
  check("identify", "<expect identifier='none'/>", "a whole number");
  check("identify", "<expect status='none' identifier='1'/>", "unknown attribute 'identifier'");
  check("identify", "<expect/><expect/>", "one <expect> at most");
  check("identify", "<expect><expect/></expect>", "no element inside");
  check("read_temperature", "<expect lowest='22' highest='21'/>", "not to be more than highest");
  check("read_temperature", "<expect lowest='400'/>", "expected -327.68 to 327.67");
  check("read_log", "<expect samples='9'/>", "a whole number from 0 to 8");
  check_error(error_of("name='identify'", "<hope/>"), "hope", "expected <expect>");
}
