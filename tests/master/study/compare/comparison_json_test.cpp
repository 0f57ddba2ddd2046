#include "master/study/compare/comparison_json.h"

#include <nlohmann/json.hpp>

#include "tests/master/study/compare/support.h"

using namespace stride::compare;

namespace {

using Json = nlohmann::ordered_json;

Json written(const Comparison& comparison, const Settings& settings = {}) {
  const TemporaryFolder folder;
  write_comparison(folder / "c.json", comparison, settings);
  return Json::parse(content(folder / "c.json"));
}

std::string keys_of(const Json& object) {
  std::string keys;
  for (const auto& [key, value] : object.items()) keys += key + " ";
  return keys;
}

}  // namespace

TEST_CASE("the keys of the file are those of the page docs/compare.md, in their order") {
  Difference difference{Kind::Signal, "tank.level", Time(kSecond), "1", "2", 3};
  difference.absolute = {1, Time(kSecond), "1", "2"};
  Comparison comparison{.a = "x", .b = "y", .differences = {difference}};
  comparison.inputs = {{"option", "--set", "a.b=1", ""}};
  const Json json = written(comparison, {.tolerances = {{"tank.*", {1, 2}, {}}}});
  CHECK(keys_of(json) ==
        "format version a b equal settings compared differences inputs notes not_compared ");
  CHECK(keys_of(json["settings"]) == "absolute relative signals time only ignored golden ");
  CHECK(keys_of(json["settings"]["signals"][0]) == "signal absolute relative ");
  CHECK(keys_of(json["compared"]) == "signals rows messages ");
  CHECK(keys_of(json["differences"][0]) == "kind name time a b count absolute relative ");
  CHECK(keys_of(json["differences"][0]["absolute"]) == "value time a b ");
  CHECK(keys_of(json["inputs"][0]) == "kind name a b ");
}

TEST_CASE("what is there is written, and what is not is null") {
  Difference difference{Kind::File, "events.csv", {}, "present", "missing"};
  Comparison comparison{.a = "x", .b = "y", .differences = {difference}};
  const Json json = written(comparison);
  CHECK(json["format"] == "stride comparison");
  CHECK(json["version"] == 1);
  CHECK(json["a"] == "x");
  CHECK(json["equal"] == false);
  CHECK(json["differences"][0]["kind"] == "file");
  CHECK(json["differences"][0]["time"].is_null());
  CHECK(json["differences"][0]["absolute"].is_null());
  CHECK(json["inputs"].is_null());
  CHECK(json["settings"]["time"].is_null());
  CHECK(written({})["equal"] == true);
  CHECK(written({}, {.time_tolerance = kSecond / 2})["settings"]["time"] == 0.5);
}
