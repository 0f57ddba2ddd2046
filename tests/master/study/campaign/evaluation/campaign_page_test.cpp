#include "master/study/campaign/evaluation/campaign_page.h"

#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/master/report/support.h"
#include "tests/master/study/campaign/records.h"

using namespace stride::campaign;
using namespace stride::tests;
using nlohmann::json;
using stride::report::data_of;
using stride::report::unpacked;

namespace {

std::vector<std::string> joined_texts(const json& blob) {
  std::vector<std::string> texts(1);
  for (const std::uint8_t byte : unpacked<std::uint8_t>(blob.at("bytes"))) {
    if (byte == 0) {
      texts.emplace_back();
    } else {
      texts.back() += static_cast<char>(byte);
    }
  }
  texts.pop_back();
  CHECK(blob.at("count") == texts.size());
  return texts;
}

struct PageOfRecords : Records {
  using Records::Records;

  json page(const std::string& name = "out/campaign.html", std::uint64_t most = 100) const {
    std::filesystem::create_directories((folder / name).parent_path());
    write_campaign_page(folder / name, plan, cases, "report.html", {}, most);
    return data_of(content(folder / name));
  }
};

}  // namespace

TEST_CASE("the page of a campaign has what became of each case, and what repeats it") {
  const PageOfRecords records;
  records.write(
      0, {.aggregates = {0.5}, .wall_time = 1, .began = "2026-11-25T23:59:59Z", .host = "a"});
  records.write(2, {.outcome = Outcome::Failed,
                    .reason = "low: </script>\nmore",
                    .verdicts = {{"low", "Never", false, "", 0.5, CaseMargin{-0.5, "V", 1}}},
                    .aggregates = {0.25},
                    .has_results = true,
                    .wall_time = 2,
                    .began = "2026-11-26T00:00:01Z",
                    .host = "b"});
  records.touch("out/cases/000/000002/report.html");
  const json page = records.page();
  CHECK(page["stride"] == "1.0");
  CHECK(page["campaign"] == json::parse(R"({"name": "c", "file": "c.xosc", "scenario": "x.ssd",
      "sampling": "independent", "random_seed": 7.0, "keep": "failed", "cases": 4})"));
  CHECK(page["outcomes"][0] == json{{"name", "passed"}, {"cases", 1}});
  CHECK(page["outcomes"][1] == json{{"name", "failed"}, {"cases", 1}});
  CHECK(page["outcomes"][5] == json{{"name", "missing"}, {"cases", 2}});
  CHECK(page["wall_time"] == 3);
  CHECK(page["began"] == json{"2026-11-25T23:59:59Z", "2026-11-26T00:00:01Z"});
  CHECK(page["hosts"] == json::parse(R"([{"name": "a", "cases": 1}, {"name": "b", "cases": 1}])"));
  const Fingerprints& made_from = records.plan.fingerprints();
  REQUIRE(page["sources"].size() == made_from.files.size() + made_from.units.size());
  CHECK(page["sources"][0] == json{{"what", "x.ssd"}, {"sha256", made_from.files.at("x.ssd")}});
  CHECK(page["sources"].back()["what"] == "unit " + made_from.units.rbegin()->first);
  CHECK(page["checks"][0]["failed"] == 1);
  const json& cases = page["cases"];
  CHECK(unpacked<std::int32_t>(cases["indices"]) == std::vector<std::int32_t>{0, 1, 2, 3});
  CHECK(unpacked<std::uint8_t>(cases["outcomes"]) == std::vector<std::uint8_t>{0, 5, 1, 5});
  CHECK(unpacked<double>(cases["failed_at"])[2] == 0.5);
  CHECK(joined_texts(cases["reasons"]) ==
        std::vector<std::string>{"", "", "low: </script>\nmore", ""});
  CHECK(joined_texts(cases["links"]) ==
        std::vector<std::string>{"", "", "cases/000/000002/report.html", ""});
  CHECK(joined_texts(cases["hosts"]) == std::vector<std::string>{"a", "", "b", ""});
  CHECK(joined_texts(cases["began"])[2] == "2026-11-26T00:00:01Z");
  CHECK(joined_texts(cases["commands"])[2] == records.plan.command(records.plan.at(2)));
  CHECK(page["parameters"][0]["name"] == "b.u");
  CHECK(unpacked<double>(page["parameters"][0]["values"])[2] ==
        std::stod(*records.plan.at(2).values[0]));
  CHECK(page["aggregates"][0]["name"] == "a, \"b\"");
  CHECK(unpacked<double>(page["aggregates"][0]["values"])[0] == 0.5);
  CHECK((page["margins"][0]["name"] == "low" && page["margins"][0]["unit"] == "V"));
  CHECK(unpacked<double>(page["margins"][0]["values"])[2] == -0.5);
  CHECK(page["correlations"][0]["failure"]["count"] == 2);
}

TEST_CASE("links lead from where the page is to what is there") {
  const PageOfRecords records;
  records.write(1, {.aggregates = {0.5}, .has_results = true});
  records.touch("out/cases/000/000001/run.json");
  CHECK(joined_texts(records.page()["cases"]["links"])[1] == "cases/000/000001/");
  CHECK(joined_texts(records.page("pages/p.html")["cases"]["links"])[1] ==
        "../out/cases/000/000001/");
}

TEST_CASE("the same records make the same page, and those of too many cases a smaller one") {
  const PageOfRecords records("500");
  records.write(4, {.aggregates = {0.5}});
  const json page = records.page("out/a.html");
  CHECK(page["cases"]["count"] == 100);
  CHECK(page["campaign"]["cases"] == 500);
  CHECK(page["outcomes"][5]["cases"] == 499);
  CHECK(records.page("out/b.html") == page);
  CHECK(content(records.folder / "out/a.html") == content(records.folder / "out/b.html"));
}

TEST_CASE("texts of a campaign's values are listed with their shares") {
  const PageOfRecords records(deterministic(value_set("a.boolean", {"true", "false"})), "");
  records.write(1, {.outcome = Outcome::Error, .reason = "no"});
  const json page = records.page();
  CHECK(page["campaign"]["sampling"] == "all combinations");
  CHECK(page["campaign"]["random_seed"].is_null());
  CHECK(page["correlations"].empty());
  CHECK(page["parameters"][0]["values"]["type"] == "strings");
  const json& share = page["shares"][0]["values"][0];
  CHECK(share["value"] == "false");
  CHECK(share["cases"] == 1);
  CHECK(share["failed"] == 1);
  CHECK(share["confidence"][1] == 1);
}
