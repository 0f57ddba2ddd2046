#include "units/reader/program.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "tests/units/reader/programs.h"

using reader::parse_program;
using reader::Program;

namespace {

using reader::tests::at;

// The lines of a program, with their numbers; each test changes one of them.
struct Lines {
  std::string version = R"(<reader-program version="1">)";                                // 1
  std::string axis = R"(<axes><axis name="a"/><axis name="b"/></axes>)";                  // 2
  std::string pose = R"(<poses><pose name="rest" a="0" b="1"/></poses>)";                 // 3
  std::string waypoint = R"(<motion><waypoint at="0.5" pose="rest"/></motion>)";          // 4
  std::string antenna = R"(<antenna on="6.1" off="9.0" power="0.5"/>)";                   // 5
  std::string command = R"(<command at="6.5" name="read_temperature" timeout="0.02"/>)";  // 6

  std::string text() const {
    return version + "\n" + axis + "\n" + pose + "\n" + waypoint + "\n" + antenna + "\n" + command +
           "\n</reader-program>\n";
  }
};

Program parse(const Lines& lines) { return parse_program(lines.text(), "p.xml"); }

template <class Change>
std::string error_of(Change change) {
  Lines lines;
  change(lines);
  try {
    parse(lines);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "accepted";
}

auto starts_with(const std::string& text) { return Catch::StartsWith(text); }
auto contains(const std::string& text) { return Catch::Contains(text); }

}  // namespace

TEST_CASE("A program is read as it is written") {
  const Program program = parse(Lines{});
  CHECK(program.axes == std::vector<std::string>{"a", "b"});
  REQUIRE(program.waypoints.size() == 1);
  CHECK(program.waypoints[0].at == at(0.5));
  CHECK(program.waypoints[0].positions == std::vector<double>{0.0, 1.0});
  REQUIRE(program.antenna.size() == 1);
  CHECK(program.antenna[0].on.time_since_epoch() == stride::Duration(6'100'000'000'000));
  CHECK(program.antenna[0].off == at(9.0));
  CHECK(program.antenna[0].power == 0.5);
  REQUIRE(program.commands.size() == 1);
  CHECK(program.commands[0].at == at(6.5));
  CHECK(program.commands[0].command == nfc::Command::ReadTemperature);
  CHECK(program.commands[0].arguments.empty());
  CHECK(program.commands[0].timeout == stride::Duration(20'000'000'000));
  CHECK(program.commands[0].bit_rate == 106);
}

TEST_CASE("A program needs no axes, and a command may be before its antenna interval") {
  const Program program = parse_program(
      R"(<reader-program version="1"><command at="1" name="identify"/>
         <antenna on="0" off="2" power="1"/></reader-program>)",
      "p.xml");
  CHECK(program.commands.size() == 1);
  CHECK(program.axes.empty());
}

TEST_CASE("The carrier is on from on until before off") {
  Lines lines;
  lines.antenna = R"(<antenna on="6" off="9" power="0.5"/><antenna on="9" off="10" power="0.2"/>)";
  const Program program = parse(lines);
  const auto ps = stride::Duration(1);
  CHECK(carrier_power(program, at(6) - ps) == 0.0);
  CHECK(carrier_power(program, at(6)) == 0.5);
  CHECK(carrier_power(program, at(9) - ps) == 0.5);
  CHECK(carrier_power(program, at(9)) == 0.2);
  CHECK(carrier_power(program, at(10)) == 0.0);
}

TEST_CASE("A file is read, and one that is missing is named") {
  const auto path = std::filesystem::temp_directory_path() / "stride_reader_program_test.xml";
  std::ofstream(path) << Lines{}.text();
  CHECK(reader::load_program(path.string()).axes.size() == 2);
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(reader::load_program(path.string()),
                    contains(path.string()) && contains("cannot be read"));
}

TEST_CASE("Every error has the file and the line") {
  const auto check = [](auto change, const std::string& place, const std::string& expected) {
    const std::string error = error_of(change);
    CHECK_THAT(error, starts_with("p.xml:" + place) && contains(expected));
  };

  SECTION("the root") {
    check([](Lines& l) { l.version = R"(<reader-program>)"; }, "1: <reader-program>", "'version'");
    check([](Lines& l) { l.version = R"(<reader-program version="2">)"; }, "1:", "expected 1");
    check([](Lines& l) { l.version = "<program>"; }, "", "well-formed");
    CHECK_THROWS_WITH(parse_program("<robot/>", "p.xml"), starts_with("p.xml:1: <robot>"));
    CHECK_THROWS_WITH(parse_program("", "p.xml"), contains("p.xml:"));
    CHECK_THROWS_WITH(parse_program("<!-- nothing -->", "p.xml"), contains("<reader-program>"));
    check([](Lines& l) { l.command = "hello"; }, "1: <reader-program>", "no text");
    check([](Lines& l) { l.command = "<dance/>"; }, "6: <dance>", "unknown element");
  }
  SECTION("axes") {
    check([](Lines& l) { l.axis = R"(<axes><axis/></axes>)"; }, "2: <axis>", "'name'");
    check([](Lines& l) { l.axis = R"(<axes><axis name="a"/><axis name="a"/></axes>)"; },
          "2:", "second time");
    check([](Lines& l) { l.axis = R"(<axes><axis name="name"/></axes>)"; }, "2:", "actuator");
    check([](Lines& l) { l.axis = R"(<axes><joint name="a"/></axes>)"; }, "2: <joint>", "<axis>");
    check([](Lines& l) { l.waypoint = ""; }, "1:", "<waypoint>");
    check([](Lines& l) { l.antenna = R"(<axes><axis name="c"/></axes>)"; }, "5: <axis>",
          "before the poses");
  }
  SECTION("poses") {
    check([](Lines& l) { l.pose = R"(<poses><pose name="rest" a="0"/></poses>)"; }, "3: <pose>",
          "'b'");
    check([](Lines& l) { l.pose = R"(<poses><pose name="rest" a="0" b="1" c="2"/></poses>)"; },
          "3:", "unknown attribute 'c': expected 'name', 'a', 'b'");
    check([](Lines& l) { l.pose = R"(<poses><pose name="rest" a="0" b="1,5"/></poses>)"; },
          "3:", "b=\"1,5\" is not a number");
    check([](Lines& l) { l.pose = R"(<poses><pose name="rest" a="0" b="inf"/></poses>)"; },
          "3:", "not a number");
    check(
        [](Lines& l) {
          l.pose = R"(<poses><pose name="x" a="0" b="1"/><pose name="x" a="0" b="1"/></poses>)";
        },
        "3:", "second time");
  }
  SECTION("waypoints") {
    check([](Lines& l) { l.waypoint = R"(<motion><waypoint at="0" pose="far"/></motion>)"; },
          "4: <waypoint>", "unknown pose 'far': expected one that is listed above: 'rest'");
    check([](Lines& l) { l.waypoint = R"(<motion><waypoint pose="rest"/></motion>)"; },
          "4:", "'at'");
    check([](Lines& l) { l.waypoint = R"(<motion><waypoint at="-1" pose="rest"/></motion>)"; },
          "4:", "0 to 1e15 seconds");
    check(
        [](Lines& l) {
          l.waypoint =
              "<motion>\n<waypoint at=\"2\" pose=\"rest\"/>\n<waypoint at=\"2\" pose=\"rest\"/>"
              "</motion>";
        },
        "6:", "expected a later time");
    check(
        [](Lines& l) {
          l.waypoint = R"(<motion><waypoint at="0" pose="rest"><pause/></waypoint></motion>)";
        },
        "4: <pause>", "no element inside <waypoint>");
  }
  SECTION("the antenna") {
    check([](Lines& l) { l.antenna = R"(<antenna on="9" off="9" power="1"/>)"; }, "5: <antenna>",
          "later time than on");
    check([](Lines& l) { l.antenna = R"(<antenna on="1" off="9" power="0"/>)"; },
          "5:", "more than 0 W");
    check([](Lines& l) { l.antenna = R"(<antenna on="1" off="9"/>)"; }, "5:", "'power'");
    check(
        [](Lines& l) {
          l.antenna = R"(<antenna on="1" off="9" power="1"/><antenna on="8" off="10" power="1"/>)";
        },
        "5:", "off again");
  }
  SECTION("what varies") {
    check([](Lines& l) { l.axis = R"(<axes><axis name="a" tremor="-1"/></axes>)"; }, "2: <axis>",
          "tremor=\"-1\": expected 0 to 0.5");
    check([](Lines& l) { l.axis = R"(<axes><axis name="a" start_offset="2"/></axes>)"; },
          "2:", "start_offset=\"2\": expected 0 to 1");
    check([](Lines& l) { l.antenna = R"(<variation seed="0"/>)"; }, "5: <variation>",
          "seed=\"0\": expected a whole number from 1");
    check([](Lines& l) { l.antenna = R"(<variation seed="1.5"/>)"; }, "5:", "a whole number");
    check([](Lines& l) { l.antenna = R"(<variation lowest_frequency="12"/>)"; },
          "5:", "lowest_frequency (12 Hz) to be less than highest_frequency (12 Hz)");
    check([](Lines& l) { l.antenna = R"(<variation highest_frequency="1000"/>)"; },
          "5:", "expected 0 to 100");
    check([](Lines& l) { l.antenna = R"(<variation sead="1"/>)"; }, "5:", "unknown attribute");
    check([](Lines& l) { l.antenna = R"(<variation/><variation/>)"; }, "5:", "one <variation>");
  }
  SECTION("commands") {
    check([](Lines& l) { l.command = R"(<command at="6.5" name="jump"/>)"; }, "6: <command>",
          "unknown command 'jump'");
    check([](Lines& l) { l.command = R"(<command at="9" name="identify"/>)"; },
          "6:", "the antenna is off");
    check([](Lines& l) { l.command = R"(<command at="soon" name="identify"/>)"; },
          "6:", "at=\"soon\" is not a number");
    check(
        [](Lines& l) {
          l.command =
              "<command at=\"8\" name=\"identify\"/>\n<command at=\"7\" name=\"identify\"/>";
        },
        "7:", "order of time");
  }
}

TEST_CASE("What varies from run to run is read, and by default nothing varies") {
  Lines lines;
  const Program plain = parse(lines);
  CHECK(plain.variation.tremor == std::vector<double>{0, 0});
  CHECK(plain.variation.start_offset == std::vector<double>{0, 0});
  CHECK(plain.variation.seed == 1);
  CHECK(plain.variation.lowest_frequency == 4);
  CHECK(plain.variation.highest_frequency == 12);

  lines.axis =
      R"(<axes><axis name="a" tremor="0.002"/><axis name="b" tremor="0.001" start_offset="0.1"/></axes>)";
  lines.antenna += R"(<variation seed="18446744073709551615" lowest_frequency="6"/>)";
  const Program program = parse(lines);
  CHECK(program.variation.tremor == std::vector<double>{0.002, 0.001});
  CHECK(program.variation.start_offset == std::vector<double>{0, 0.1});
  CHECK(program.variation.seed == 18446744073709551615u);
  CHECK(program.variation.lowest_frequency == 6);
}

TEST_CASE("The carrier ends where no interval goes on from there") {
  Lines lines;
  lines.antenna = R"(<antenna on="6" off="9" power="0.5"/><antenna on="9" off="10" power="0.2"/>
                     <antenna on="11" off="12" power="1"/>)";
  const Program program = parse(lines);
  CHECK_FALSE(carrier_end(program, at(5)).has_value());
  CHECK(carrier_end(program, at(6)) == at(10));
  CHECK(carrier_end(program, at(9.5)) == at(10));
  CHECK_FALSE(carrier_end(program, at(10)).has_value());
  CHECK(carrier_end(program, at(11)) == at(12));
  CHECK_FALSE(carrier_end(program, at(12)).has_value());
}
