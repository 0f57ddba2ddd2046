#include "tests/fuzz/engine.h"

#include <csignal>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/build.h"

using namespace stride::tests;

namespace {

Parser parser_of(void (*read)(const std::string& bytes)) {
  return {.name = "test", .read = read, .seeds = {"abcdef"}};
}

bool is_seed(const std::string& bytes) { return bytes == "abcdef"; }

}  // namespace

TEST_CASE("what a parser accepts and refuses is counted, and the inputs are always the same") {
  const Parser parser = parser_of([](const std::string& bytes) {
    if (bytes.size() % 2 == 0) throw Refusal("it is even");
  });
  const Tally tally = run(parser, 500, 1);
  CHECK(tally.findings.empty());
  CHECK(tally.accepted > 50);
  CHECK(tally.refused > 50);
  CHECK(tally.accepted + tally.refused == 500);
  CHECK(run(parser, 500, 1).accepted == tally.accepted);
  CHECK(run(parser, 500, 2).accepted != tally.accepted);
}

TEST_CASE("an exception that is no refusal is a finding, behind which the others are tried") {
  const Parser parser = parser_of([](const std::string& bytes) {
    if (is_seed(bytes)) throw std::runtime_error("oops");
  });
  const Tally tally = run(parser, 50, 1);
  REQUIRE(tally.findings.size() == 1);
  CHECK(is_seed(tally.findings[0].bytes));
  CHECK_THAT(tally.findings[0].what, Catch::Contains("oops"));
  CHECK(tally.accepted == 49);
}

TEST_CASE("a property that does not hold, a crash and an end of the process are findings") {
  const auto [read, what] = GENERATE(table<void (*)(const std::string&), std::string>({
      {[](const std::string&) { ensure(false, "it is so"); }, "it is so"},
      {[](const std::string&) { throw 1; }, "no std::exception"},
      {[](const std::string&) { std::raise(SIGKILL); }, "signal Killed"},
      {[](const std::string&) { std::_Exit(3); }, "exit code 3"},
      {[](const std::string&) { std::raise(SIGALRM); }, "it took longer than"},
  }));
  const Tally tally = run(parser_of(read), 100, 1);
  REQUIRE(tally.findings.size() == kMostFindings);
  CHECK_THAT(tally.findings[0].what, Catch::Contains(what));
}

TEST_CASE("memory without end is a finding") {
  if (kSanitized) return;  // where nothing limits it
  const Tally tally =
      run(parser_of([](const std::string&) { std::vector<char>(kMemory * 2); }), 1, 1);
  REQUIRE(tally.findings.size() == 1);
  CHECK_THAT(tally.findings[0].what, Catch::Contains("bad_alloc"));
}

TEST_CASE("only errors that contain what they should are refusals") {
  const auto fail = [] { throw std::invalid_argument("x.xml:3: no"); };
  CHECK_THROWS_AS(refusing<std::invalid_argument>("x.xml:", fail), Refusal);
  CHECK_THROWS_AS(refusing<std::invalid_argument>("y.xml:", fail), std::logic_error);
  CHECK_THROWS_AS(refusing<std::runtime_error>("x.xml:", fail), std::invalid_argument);
}
