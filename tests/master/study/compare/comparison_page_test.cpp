#include "master/study/compare/comparison_page.h"

#include <nlohmann/json.hpp>

#include "tests/master/report/support.h"
#include "tests/master/study/compare/support.h"

using namespace stride::compare;

namespace {

/// Of two runs, in a/ and b/: one signal differs, the other does not.
nlohmann::json page_of(const TemporaryFolder& folder) {
  for (const char* name : {"a", "b"}) std::filesystem::create_directory(folder / name);
  folder.write("a/signals.csv", "time,x.same,x.other\n0,1,2\n1,1,2\n");
  folder.write("b/signals.csv", "time,x.same,x.other\n0,1,2\n1,1,</script>\n");
  const Comparison comparison = compare_results(folder / "a", folder / "b", {});
  write_comparison_page(folder / "c.html", comparison, {}, "1.2.3");
  return stride::report::data_of(content(folder / "c.html"));
}

Names columns_of(const nlohmann::json& run) {
  Names names;
  for (const nlohmann::json& column : run["columns"]) names.push_back(column["name"]);
  return names;
}

}  // namespace

TEST_CASE("the page has all of the comparison") {
  const TemporaryFolder folder;
  const nlohmann::json page = page_of(folder);
  CHECK(page["stride"] == "1.2.3");
  CHECK(page["comparison"]["equal"] == false);
  REQUIRE(page["comparison"]["differences"].size() == 1);
  CHECK(page["comparison"]["differences"][0]["b"] == "</script>");
}

TEST_CASE("curves are all those of A, and what differs of B") {
  const TemporaryFolder folder;
  const nlohmann::json page = page_of(folder);
  CHECK(columns_of(page["a"]) == Names{"x.same", "x.other"});
  CHECK(columns_of(page["b"]) == Names{"x.other"});
  CHECK(page["a"]["rows"] == 2);
}

TEST_CASE("the page of a comparison is written whole or not at all") {
  const TemporaryFolder folder;
  page_of(folder);
  const Comparison comparison = compare_results(folder / "a", folder / "b", {});
  CHECK_THAT(
      error_of([&] { write_comparison_page(folder / "nowhere" / "c.html", comparison, {}, "1"); }),
      Catch::Contains("c.html"));
}
