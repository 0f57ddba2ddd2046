// stride campaign shrink, from outside.
#include <fstream>
#include <string>
#include <utility>

#include "tests/cli/searches.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// Seven cases in which all parameters differ from the scenario's.
std::string listed_campaign(const std::string& more = "", const std::string& extension = "") {
  return campaign_text(
      deterministic(value_set("first.u", {"0.1", "5"}) +
                    value_set("first.time_constant", {"0.9", "0.5", "1.25"}) + more),
      kNoResults + extension, "test.ssd");
}

/// As listed_campaign(), run in the folder `out`.
struct ShrunkCases : Searches {
  explicit ShrunkCases(const std::string& campaign = listed_campaign(),
                       const Parts& parts = planted_filters())
      : Searches(campaign, parts) {
    const Outcome outcome = stride({"campaign", "run", "c.xosc", "-q", "--out", "out"});
    INFO(outcome.err);
    CHECK(outcome.exit_code == 1);
  }

  Outcome shrink(const std::string& index, const Arguments& further = {}) const {
    Arguments made{"campaign", "shrink", "c.xosc", "--out", "out", "--case", index};
    made.insert(made.end(), further.begin(), further.end());
    return stride(made);
  }
  /// Whether it fails with this input.
  bool fails(const std::string& input) const {
    return run({"-q", "--set", "first.u=" + input}).exit_code == 1;
  }
};

/// The values of the parameter in the columns "fails with" and "passes with".
std::pair<std::string, std::string> boundary(const std::string& text,
                                             const std::string& parameter) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, nominal, value, fails, passes;
    if (words >> name >> nominal >> value >> fails >> passes && name == parameter) {
      return {fails, passes};
    }
  }
  FAIL("no boundary of " << parameter << " in: " << text);
  return {};
}

}  // namespace

TEST_CASE("a failing case is shrunk to what it needs, at a boundary that a dense scan has, too") {
  const ShrunkCases space;
  const Outcome outcome = space.shrink("4", {"--tolerance", "0.001"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK_THAT(outcome.out, Contains("c: case 4 fails by 'bounded', shrunk by ") &&
                              Contains(" of first.u on, all else as in the scenario.") &&
                              Contains("Parameter set in out/shrunk/000004.ssv"));
  const auto [fails, passes] = boundary(outcome.out, "first.u");
  CHECK(std::stod(fails) - std::stod(passes) == Approx(0.005).margin(0.005));
  CHECK(space.fails(fails));
  CHECK_FALSE(space.fails(passes));
  CHECK(space.run({"-q", "--parameters", "out/shrunk/000004.ssv"}).exit_code == 1);

  space.scratch().write("scan.xosc",
                        campaign_text(deterministic(value_range("first.u", "0.02", "0.02", "5")),
                                      kNoResults, "test.ssd"));
  CHECK(space.stride({"campaign", "run", "scan.xosc", "-q", "--out", "scan"}).exit_code == 1);
  std::istringstream rows(space.table("scan"));
  double first = 0;
  for (std::string row; first == 0 && std::getline(rows, row);) {
    if (row.find(",failed,") != std::string::npos) first = std::stod(row.substr(row.find(',') + 1));
  }
  CHECK(std::stod(fails) <= first + 0.005);
  CHECK(std::stod(fails) > first - 0.02 - 0.005);
}

TEST_CASE("the case of a search is shrunk from its folder, and nothing is run twice") {
  const Searches space;
  const Outcome found = space.search("found", {"--seed", "2"});
  const std::size_t at = found.err.find("--case ");
  REQUIRE(at != std::string::npos);
  const std::string index = found.err.substr(at + 7, found.err.find('\n', at) - at - 7);
  const Arguments arguments{"campaign", "shrink", "found", "--case", index};
  const Outcome one = space.stride(arguments);
  INFO(one.out << one.err);
  CHECK(one.exit_code == 0);
  CHECK_THAT(one.out, Contains("c: case " + index + " fails by 'bounded'") &&
                          Contains("s of first.time_constant down") && Contains(" of first.u on"));
  const auto [fails, passes] = boundary(one.out, "first.u");
  CHECK(std::stod(passes) < std::stod(fails));

  const fs::path folder =
      space / ("found/shrunk/" + std::string(6 - index.size(), '0') + index + "/cases/000");
  const auto before = fs::last_write_time(folder / "000003.json");
  CHECK(space.stride(arguments).out == one.out);
  CHECK(fs::last_write_time(folder / "000003.json") == before);

  Arguments finer = arguments;
  finer.insert(finer.end(), {"--tolerance", "0.0001"});
  const Outcome fine = space.stride(finer);
  CHECK(fine.exit_code == 0);
  CHECK(space.stride(arguments).out == one.out);
  fs::remove_all(space / "found/shrunk");
  CHECK(space.stride(finer).out == fine.out);
}

TEST_CASE("a record of another case is not believed") {
  const Searches space;
  CHECK(space.search("found", {"--seed", "2"}).exit_code == 1);
  const auto record = [&](const std::string& folder, const std::string& index) {
    return space / (folder + "/cases/000/0000" + index + ".json");
  };
  const auto put = [&](const std::string& folder, const std::string& from, const std::string& to) {
    std::string text = read(record(folder, from));
    const std::string key = "\"case\":" + std::to_string(std::stoi(from));
    text.replace(text.find(key), key.size(), "\"case\":" + std::to_string(std::stoi(to)));
    std::ofstream(record(folder, to)) << text;
  };
  const Arguments arguments{"campaign", "shrink", "found", "--case", "16"};
  const Outcome outcome = space.stride(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);

  const std::string shrunk = "found/shrunk/000016";
  const std::string failing = read(record(shrunk, "00"));
  for (const char* index : {"01", "02", "07"}) put(shrunk, "00", index);
  put(shrunk, "03", "00");
  CHECK(space.stride(arguments).out == outcome.out);
  const auto values_of = [](const std::string& text) {
    return text.substr(0, text.find("\"outcome\""));
  };
  CHECK(values_of(read(record(shrunk, "00"))) == values_of(failing));

  fs::copy_file(record("found", "16"), record("found", "12"), fs::copy_options::overwrite_existing);
  const Outcome other = space.stride({"campaign", "shrink", "found", "--case", "12"});
  CHECK(other.exit_code == 2);
  CHECK_THAT(other.err, Contains("found/cases/000/000012.json: this is not the record of case 12"));
  CHECK_THAT(other.err, Contains("remove it; the same search runs the case again"));
  std::string edited = read(record("found", "16"));
  const std::string key = "\"first.u\":\"0.";
  edited.insert(edited.find(key) + key.size(), "5");
  std::ofstream(record("found", "16")) << edited;
  CHECK(space.stride(arguments).exit_code == 2);
  fs::remove(record("found", "16"));
  CHECK(space.search("found", {"--seed", "2"}).exit_code == 1);
  CHECK(space.stride(arguments).out == outcome.out);
}

TEST_CASE("an intervention is shrunk, and its unit of measure is shown") {
  const ShrunkCases space(
      listed_campaign(value_set("wire.from", {"0.25"}) + value_set("wire.value", {"1.5"}),
                      "<stride:Intervention name='wire'><stride:Force variable='second.u' "
                      "value='0' from='0.75'/></stride:Intervention>"));
  const Outcome outcome = space.shrink("0");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("It fails from 0.") && Contains(" of wire.from down, from 1.") &&
                              Contains(" of wire.value on, all else as in the scenario.") &&
                              Contains("first.time_constant [s]") && Contains("--force") &&
                              Contains("without swaps and interventions"));
}

TEST_CASE("what cannot be shrunk is refused") {
  const ShrunkCases space;
  const auto check_refused = [&](const std::string& index, const Arguments& further,
                                 const std::string& why) {
    const Outcome outcome = space.shrink(index, further);
    INFO(outcome.err);
    CHECK(outcome.exit_code == 2);
    CHECK_THAT(outcome.err, Contains(why));
  };
  check_refused("1", {}, "--case 1: this case passes, so there is nothing to shrink");
  check_refused("6", {}, "--case 6: the campaign has 6 cases, the last one is 5");
  for (const char* tolerance : {"0", "nan", "0.6", "x"}) {
    check_refused("4", {"--tolerance", tolerance}, "is no number from 1e-09 to 0.5");
  }
  check_refused("4", {"--check", "bounden"}, "did you mean 'bounded'?");
  CHECK(space.stride({"campaign", "search", "c.xosc", "-q", "--runs", "1"}).exit_code == 0);
  const Outcome unknown = space.stride({"campaign", "shrink", "campaigns/c.search", "--case", "1"});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Contains("--case 1: the search has run no such case"));
  CHECK(space.stride({"campaign", "shrink", "c.xosc", "--case", "1"}).exit_code == 2);
}

TEST_CASE("the failure that stays is the one that is named") {
  const ShrunkCases space(
      listed_campaign(),
      planted_filters("<stride:Always name='other' signal='first.y' max='0.9'/>"));
  const Outcome first = space.shrink("4");
  const Outcome other = space.shrink("4", {"--check", "other"});
  CHECK_THAT(first.out, Contains("case 4 fails by 'bounded'"));
  CHECK_THAT(other.out, Contains("case 4 fails by 'other'"));
  CHECK(boundary(first.out, "first.u") != boundary(other.out, "first.u"));
}

TEST_CASE("a crash is shrunk as other failures are") {
  Parts parts{component("c", "faulty.fmu") + component("other", "minimal.fmu"), ""};
  parts.annotation =
      "<stride:Checks><stride:Always name='bounded' signal='other.y' max='5'/></stride:Checks>\n";
  const ShrunkCases space(
      campaign_text(deterministic(value_set("c.call", {"step"}) + value_set("c.at", {"0.5"}) +
                                  value_set("c.fault", {"segfault"}) + value_set("other.u", {"3"})),
                    kNoResults, "test.ssd"),
      parts);
  const Outcome outcome = space.shrink("0");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("case 0 fails by 'crashed'") &&
                              Contains("with c.fault = segfault, all else as in the scenario"));
}
