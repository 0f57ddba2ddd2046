// What the program takes for granted of the pages: where the data goes, and that it needs nothing
// from elsewhere.
#include "master/report/page.h"

#include <regex>
#include <string>
#include <string_view>

#include <catch2/catch.hpp>

namespace report = stride::report;

namespace {

std::string any_page() {
  const auto page = GENERATE(report::page, report::campaign_page, report::comparison_page);
  return std::string(page());
}

}  // namespace

TEST_CASE("the mark for the data is in a page once, on its own line, before the script") {
  const std::string page = any_page();
  const std::string line = "\n" + std::string(report::kDataMark) + "\n";
  const std::size_t mark = page.find(line);
  REQUIRE(mark != std::string::npos);
  CHECK(page.find(report::kDataMark, mark + line.size()) == std::string::npos);
  CHECK(page.find("<script>", mark) != std::string::npos);
}

TEST_CASE("a page loads nothing and allows nothing to be loaded") {
  const std::string page = any_page();
  CHECK(page.find("default-src 'none'") != std::string::npos);
  const std::regex loads(R"re((src|href)=["']?(https?:)?//)re");
  CHECK_FALSE(std::regex_search(page, loads));
}

TEST_CASE("a page says so where JavaScript is off") {
  CHECK(any_page().find("<noscript><p class=\"warning\">") != std::string::npos);
}

TEST_CASE("the page of a run carries the licences of what is bundled") {
  const std::string page(report::page());
  for (const char* name : {"uplot", "@dagrejs/dagre", "@dagrejs/graphlib"}) {
    INFO(name);
    CHECK(page.find(std::string("\n") + name + "\n") != std::string::npos);
  }
  CHECK(page.find("Permission is hereby granted") != std::string::npos);
}

TEST_CASE("what draws worlds has its licences apart, since it is not in all pages") {
  const std::string licences(report::world_licences());
  CHECK(licences.find("\nthree\n") != std::string::npos);
  CHECK(licences.find("Permission is hereby granted") != std::string::npos);
  CHECK(report::page().find("\nthree\n") == std::string_view::npos);
}
