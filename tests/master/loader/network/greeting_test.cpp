#include "master/loader/network/greeting.h"

#include <catch2/catch.hpp>

#include "master/loader/wire/calls.h"
#include "tests/error_of.h"

using namespace stride;
using namespace stride::remote;
using stride::tests::error_of;

TEST_CASE("a greeting is found in what arrives piece by piece") {
  const std::string line = greeting_line(Side::Server, {7, "1.2.0-rc1"});
  GreetingScanner scanner(Side::Server);
  for (std::size_t i = 0; i + 1 < line.size(); ++i) CHECK_FALSE(scanner.take(line.substr(i, 1)));
  const auto greeting = scanner.take("\nrest");
  REQUIRE(greeting);
  CHECK(greeting->protocol == 7);
  CHECK(greeting->build == "1.2.0-rc1");
  CHECK(scanner.noise().empty());
  CHECK(scanner.rest() == "rest");
}

TEST_CASE("what a login prints before the greeting is kept as noise") {
  GreetingScanner scanner(Side::Server);
  CHECK_FALSE(scanner.take("Welcome\nto this machine\n\x01STRI"));
  const auto greeting = scanner.take("DE-SERVE protocol 1, build 2\n");
  REQUIRE(greeting);
  CHECK(scanner.noise() == "Welcome\nto this machine\n");
}

TEST_CASE("what is no greeting is refused") {
  CHECK(error_of([] {
          GreetingScanner(Side::Server).take(std::string(GreetingScanner::kMostNoise + 99, 'x'));
        }) == "it prints, and does not greet");
  for (const char* text : {"", "1", "1, build ", "x, build 1", "1, build a b", "1, build \x1b[1m",
                           "99999999999999, build 1"}) {
    INFO(text);
    GreetingScanner scanner(Side::Server);
    CHECK_THROWS_AS(scanner.take("\x01STRIDE-SERVE protocol " + std::string(text) + "\n"),
                    BadGreeting);
  }
  CHECK_THROWS_AS(
      GreetingScanner(Side::Server).take("\x01STRIDE-SERVE protocol " + std::string(300, '1')),
      BadGreeting);
}

TEST_CASE("each side looks for the other's greeting only") {
  CHECK_FALSE(GreetingScanner(Side::Server).take(greeting_line(Side::Master, own_greeting())));
  CHECK(GreetingScanner(Side::Master).take(greeting_line(Side::Master, own_greeting())));
}

TEST_CASE("the protocol is raised with the table of calls, whose places are their numbers") {
  CHECK(kProtocol == 3);
  CHECK(isolation::kCallCount == 28);
  CHECK(isolation::code_of<&core::Unit::get>() == isolation::RequestCode{9});
  CHECK(isolation::code_of<&core::HostDiagnostics::host_statistics>() ==
        isolation::RequestCode{32});
}
