#include "master/observe/coverage/ucis.h"

#include <set>

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "master/observe/coverage/merge.h"
#include "tests/master/base/archive/support.h"
#include "tests/master/observe/coverage/support.h"

using namespace stride;
using namespace stride::coverage;

namespace {

Report ucis_example(bool has_message) { return example_report("an example", 90.5, has_message); }

/// Within the only group.
template <class Look>
void look_at_ucis(const Report& report, Look&& look) {
  const tests::Scratch scratch;
  scratch.write("coverage.xml",
                ucis_document(report, {{"a.json", "b/<c>.json"}, "1.2.3", "2026-11-26T12:00:00"}));
  const xml::Document document(scratch / "coverage.xml", "coverage.xml");
  const xml::Element& root = document.root();
  CHECK(root.required("ucisVersion") == "1.0");
  CHECK(root.required("writtenTime") == "2026-11-26T12:00:00");
  const auto histories = root.children({"", "historyNodes"});
  REQUIRE(histories.size() == 2);
  CHECK(histories[1].required("physicalName") == "b/<c>.json");
  CHECK(histories[1].required("vendorToolVersion") == "1.2.3");
  const auto instance = root.child({"", "instanceCoverages"});
  REQUIRE(instance);
  look(*instance->child({"", "covergroupCoverage"})->child({"", "cgInstance"}));
}

std::string count_in(const xml::Element& holder) {
  return holder.child({"", "contents"})->required("coverageCount");
}

}  // namespace

TEST_CASE("UCIS: bins with their names, numbers, kinds and counts") {
  look_at_ucis(ucis_example(true), [](const xml::Element& group) {
    CHECK(group.child({"", "options"})->required("goal") == "91");
    const auto points = group.children({"", "coverpoint"});
    REQUIRE(points.size() == 2);
    CHECK(points[0].required("name") == "level");
    CHECK(points[0].child({"", "options"})->required("weight") == "1");
    const auto bins = points[0].children({"", "coverpointBin"});
    REQUIRE(bins.size() == 5);
    CHECK((bins[0].required("name") == "[0, 1)" && bins[0].required("type") == "bins"));
    CHECK(count_in(*bins[0].child({"", "range"})) == "1");
    CHECK((bins[1].required("key") == "1" && count_in(*bins[1].child({"", "range"})) == "0"));
    CHECK((bins[3].required("name") == "> 2" && bins[3].required("type") == "ignore"));
    // what is open is known as far as it was seen only, so it is no part of the percentage
    CHECK(points[1].child({"", "options"})->required("weight") == "0");
    CHECK(points[1].child({"", "coverpointBin"})->required("name") == "read");
  });
}

TEST_CASE("UCIS: a cross names its parts, and each of its bins the numbers of theirs") {
  look_at_ucis(ucis_example(true), [](const xml::Element& group) {
    const auto cross = group.child({"", "cross"});
    REQUIRE(cross);
    const auto parts = cross->children({"", "crossExpr"});
    REQUIRE(parts.size() == 2);
    CHECK((parts[0].text() == "level" && parts[1].text() == "words"));
    const auto bins = cross->children({"", "crossBin"});
    REQUIRE(bins.size() == 1);
    CHECK(bins[0].required("name") == "[0, 1) × read");
    const auto numbers = bins[0].children({"", "index"});
    REQUIRE(numbers.size() == 2);
    CHECK((numbers[0].text() == "0" && numbers[1].text() == "0"));
    CHECK(count_in(bins[0]) == "1");
  });
}

TEST_CASE("UCIS: a point without a bin, and what crosses it, is left out") {
  look_at_ucis(ucis_example(false), [](const xml::Element& group) {
    CHECK(group.children({"", "coverpoint"}).size() == 1);
    CHECK_FALSE(group.child({"", "cross"}));
  });
}

TEST_CASE("UCIS: what is told apart has names of its own, and says why") {
  const auto crossed = [](const char* first) {
    GroupDefinition group =
        group_of({values_of("a", 0, Items({{0, first}, {1, "on"}})), values_of("b", 1, truths())});
    group.points.push_back(cross_of(group, {0, 1}));
    return empty_report("s", std::vector{group}, 1);
  };
  Report report = crossed("off");
  merge(report, crossed("dark"));
  look_at_ucis(report, [](const xml::Element& group) {
    const auto points = group.children({"", "coverpoint"});
    const auto crosses = group.children({"", "cross"});
    REQUIRE((points.size() == 3 && crosses.size() == 2));
    std::set<std::string> names;
    for (const auto& point : points) names.insert(point.required("name"));
    CHECK(names.size() == 3);
    CHECK_THAT(points[1].child({"", "options"})->required("comment"),
               Catch::StartsWith("1 of 2 runs: bin 1 is "));
    CHECK_FALSE(points[2].child({"", "options"})->attribute("comment"));
    for (const auto& cross : crosses) {
      CHECK(names.count(cross.children({"", "crossExpr"})[0].text()) == 1);
      CHECK(cross.children({"", "crossBin"})[0].children({"", "index"})[0].text() == "0");
    }
  });
}
