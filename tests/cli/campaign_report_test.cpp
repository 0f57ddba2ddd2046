// stride campaign report, from outside.
#include <cstdlib>

#include "tests/cli/campaigns.h"
#include "tests/master/report/support.h"

using namespace stride::tests;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// Draws of the input of the first of two filters, and a check that fails where it is too large.
struct ReportedCampaign : Workspace {
  explicit ReportedCampaign(const std::string& runs, const std::string& keep = "failed")
      : Workspace(checked_filters()) {
    scratch().write("c.xosc",
                    drawn_input(runs, "<stride:Keep results='" + keep +
                                          "'/><stride:Aggregate name='last' signal='second.y' "
                                          "function='final'/>"));
  }

  Outcome campaign(const Arguments& further) const {
    Arguments arguments{"campaign"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return stride(arguments);
  }
  std::string text(const std::string& name) const { return read(scratch() / name); }
  json page(const std::string& name) const { return stride::report::data_of(text(name)); }
};

}  // namespace

TEST_CASE("a campaign's run writes its page, and campaign report the same one") {
  const ReportedCampaign space("12");
  const Outcome run = space.campaign({"run", "c.xosc"});
  INFO(run.err);
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.out, Contains("\nPage in campaigns/c/campaign.html\n"));
  const std::string before = space.text("campaigns/c/campaign.html");
  const json page = stride::report::data_of(before);
  CHECK(page["stride"] == STRIDE_VERSION);
  CHECK(page["campaign"]["cases"] == 12);
  CHECK(page["working_folder"] == "../..");
  CHECK(page["outcomes"][1]["cases"] == page["checks"][0]["failed"]);
  const auto value = page["correlations"][0]["aggregates"][0]["value"].get<double>();
  CHECK(value > 0.99);
  fs::remove(space / "campaigns/c/campaign.html");
  const Outcome again = space.campaign({"report", "campaigns/c"});
  CHECK(again.exit_code == 0);
  CHECK(again.err == "");
  CHECK(again.out == "Page in campaigns/c/campaign.html\n");
  CHECK(space.text("campaigns/c/campaign.html") == before);
  CHECK(space.campaign({"report", "c.xosc", "--page", "page.html"}).exit_code == 0);
  CHECK(space.page("page.html")["outcomes"] == page["outcomes"]);
  CHECK(space.page("page.html")["working_folder"] == ".");
  CHECK(space.left_behind().empty());
}

TEST_CASE("links of the page lead to the pages of cases") {
  const ReportedCampaign space("3", "all");
  REQUIRE(space.campaign({"run", "c.xosc", "-q"}).exit_code != 2);
  const auto bytes = stride::report::unpacked<std::uint8_t>(
      space.page("campaigns/c/campaign.html")["cases"]["links"]["bytes"]);
  const std::string links(bytes.begin(), bytes.end());
  for (const char* name : {"000000", "000001", "000002"}) {
    const std::string link = std::string("cases/000/") + name + "/report.html";
    CHECK_THAT(links, Contains(link));
    CHECK(fs::exists(space / "campaigns/c" / link));
  }
}

TEST_CASE("the page of an unfinished campaign says what is missing") {
  const ReportedCampaign space("4", "none");
  REQUIRE(space.campaign({"run", "c.xosc", "-q", "--case", "2"}).exit_code != 2);
  const Outcome outcome = space.campaign({"report", "c.xosc"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(space.page("campaigns/c/campaign.html")["outcomes"][5] ==
        json{{"name", "missing"}, {"cases", 3}});
}

TEST_CASE("what campaign report refuses") {
  const ReportedCampaign space("2", "none");
  CHECK_THAT(input_error_of(space.campaign({"report", "c.xosc"})),
             Contains("campaigns/c: there is no plan in this folder"));
  REQUIRE(space.campaign({"run", "c.xosc", "-q"}).exit_code != 2);
  for (const char* file : {"c.xosc", "test.ssd", "campaigns/c/cases.csv"}) {
    const std::string before = space.text(file);
    CHECK_THAT(input_error_of(space.campaign({"report", "c.xosc", "--page", file})),
               Contains("--page " + std::string(file)));
    CHECK(space.text(file) == before);
  }
}

TEST_CASE("campaign report opens the page in a browser") {
  const ReportedCampaign space("2", "none");
  REQUIRE(space.campaign({"run", "c.xosc", "-q"}).exit_code != 2);
  ::setenv("BROWSER", "no_such_browser", 1);
  const Outcome outcome = space.campaign({"report", "c.xosc", "--open"});
  ::unsetenv("BROWSER");
  CHECK(outcome.exit_code == 1);
  CHECK_THAT(outcome.err, Contains("cannot open campaigns/c/campaign.html"));
}

TEST_CASE("the pages of a campaign and of its cases have the coverage") {
  Parts parts = two_filters();
  parts.annotation =
      "<stride:Coverage><stride:Group component='second'>"
      "<stride:Values signal='y' edges='0 0.1 1'/></stride:Group></stride:Coverage>";
  const Workspace workspace(parts);
  workspace.scratch().write("c.xosc", drawn_input("3", "<stride:Keep results='all'/>"));
  REQUIRE(workspace.stride({"campaign", "run", "c.xosc", "-q"}).exit_code == 0);
  const auto coverage_in = [&](const std::string& page) {
    return stride::report::data_of(read(workspace / "campaigns/c" / page))["coverage"];
  };
  const json merged = coverage_in("campaign.html");
  CHECK(merged["cases"] == 3);
  CHECK(merged["groups"][0]["points"][0]["bins"][0]["case"] == 0);
  CHECK(merged == json::parse(read(workspace / "campaigns/c/coverage.json")));
  const std::string results = "cases/000/000002/";
  CHECK(coverage_in(results + "report.html") ==
        json::parse(read(workspace / "campaigns/c" / results / "coverage.json")));
}
