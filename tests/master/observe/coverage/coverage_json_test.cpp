#include "master/observe/coverage/coverage_json.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/master/base/archive/support.h"
#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

namespace {

Report json_example() { return example_report("example", 90); }

std::string reading_refusal(const std::string& text) {
  const tests::Scratch scratch;
  scratch.write("coverage.json", text);
  try {
    read_coverage(scratch / "coverage.json");
  } catch (const core::Error& mistake) {
    CHECK(mistake.kind() == core::Error::Kind::Input);
    return mistake.message();
  }
  return "";
}

}  // namespace

TEST_CASE("coverage.json reads back as it was written") {
  const tests::Scratch scratch;
  Report report = json_example();
  write_coverage(scratch / "a.json", report);
  CHECK(read_coverage(scratch / "a.json") == report);
  report.cases = 7;
  for (BinCount& bin : report.groups[0].points[0].bins) {
    if (bin.count > 0) bin.in_case = 3;
  }
  write_coverage(scratch / "b.json", report);
  CHECK(read_coverage(scratch / "b.json") == report);
}

TEST_CASE("the keys of coverage.json are those of the page docs/coverage.md, in their order") {
  const tests::Scratch scratch;
  write_coverage(scratch / "coverage.json", json_example());
  const auto json = nlohmann::ordered_json::parse(tests::read(scratch / "coverage.json"));
  const auto keys = [](const nlohmann::ordered_json& object) {
    std::string all;
    for (const auto& [key, value] : object.items()) all += key + " ";
    return all;
  };
  CHECK(keys(json) == "format version scenario definition groups ");
  CHECK(keys(json["groups"][0]) == "component goal percentage points ");
  const auto& points = json["groups"][0]["points"];
  CHECK(keys(points[0]) == "name definition kind signal unit at_least open percentage bins ");
  CHECK(keys(points[2]) == "name definition kind of of_definitions at_least open percentage bins ");
  CHECK(points[0]["bins"][0].dump() == R"j({"name":"[0, 1)","count":1,"first":0.0})j");
  CHECK(points[0]["bins"][1].dump() == R"({"name":"[1, 2]","count":0})");
  CHECK(points[0]["bins"][3].dump() == R"({"name":"> 2","count":1,"first":0.001,"ignored":true})");
  CHECK(points[1]["percentage"].is_null());
}

TEST_CASE("coverage of a case is short, and reads back") {
  const CoveredBins covered = covered_bins(json_example());
  const auto json = to_json(covered);
  CHECK(json.dump() == R"j({"device":{"level":{"[0, 1)":[1,0.0],"> 2":[1,0.001]},)j"
                       R"j("words":{"read":[1,0.001]},"cross":{"[0, 1) × read":[1,0.001]}}})j");
  CHECK(covered_bins_of(json) == covered);
}

TEST_CASE("what is no coverage is refused") {
  CHECK(reading_refusal("{}") == "this is no coverage");
  CHECK(reading_refusal("[1, 2]") == "this is no coverage");
  CHECK(reading_refusal("{").find("this is no coverage of stride") == 0);
  CHECK(reading_refusal(R"({"format":"stride coverage","version":2})") ==
        "it is of another version than 1");
  CHECK(reading_refusal(R"({"format":"stride coverage","version":1,"scenario":"s"})")
            .find("definition") != std::string::npos);
  const std::string head = R"({"format":"stride coverage","version":1,"scenario":"s",)"
                           R"("definition":"","groups":[{"component":"c","points":[)";
  const auto with = [&](const std::string& kind, const std::string& bin) {
    return reading_refusal(head + R"({"name":"p","definition":"0f","kind":")" + kind +
                           R"(","signal":"x","unit":"","at_least":1,"open":false,"bins":[)" + bin +
                           "]}]}]}");
  };
  CHECK(with("values", R"({"name":"b","count":1,"first":0})").empty());
  CHECK(with("colours", "") == "'colours' is no kind of a point");
  CHECK(with("values", R"({"name":"b","count":-1})") ==
        "expected a whole number that is not negative");
  CHECK(with("values", R"({"name":"b","count":1})") ==
        "bin 'b': there is an instant without a visit, or none");
}
