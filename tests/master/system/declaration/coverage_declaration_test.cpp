#include "master/system/declaration/coverage_declaration.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "master/system/declaration/coverage_writer.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;

namespace {

/// The elements begin in line 2.
template <class Read>
auto read_below(const std::string& root, const std::string& elements, Read&& read) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("x.ssd", "<stride:" + root + " xmlns:stride='urn:org.stride:scenario:1'>\n" +
                                elements + "</stride:" + root + ">");
  const xml::Document document(file, "x.ssd");
  return read(document.root());
}

std::string coverage_error(const std::string& point) {
  return error_of([&] {
    read_below("Coverage", "<stride:Group component='a'>" + point + "</stride:Group>",
               &read_coverage);
  });
}

std::string covered_error(const std::string& element) {
  return error_of([&] { read_below("Checks", element, &read_covered); });
}

}  // namespace

TEST_CASE("groups and points in their order, with their lines, also written anew") {
  const bool is_written = GENERATE(false, true);
  const std::string text =
      "<stride:Group component='a' goal='90.5' atLeast='2'>\n"
      "<stride:Values name='near' signal='d' min='0' max='2.5' bins='5' scale='log'/>\n"
      "<stride:Values signal='e' edges='0 1e-3 1' atLeast='3'/>\n"
      "<stride:Transitions signal='led'/>\n"
      "<stride:Words event='frame' words=' read  write '/>\n"
      "<stride:Lengths event='frame' max='20'/><stride:Sequences event='frame'/>\n"
      "<stride:Gaps event='frame' min='1e-3' max='10'/>\n"
      "<stride:Cross name='both' of='near led'/>\n"
      "<stride:Ignore point='near' bins='[0, 1)'/>\n"
      "</stride:Group>\n<stride:Group component='b'/>\n";
  auto groups = read_below("Coverage", text, &read_coverage);
  if (is_written) {
    xml::Writer writer;
    writer.open("stride:Coverage");
    writer.attribute("xmlns:stride", "urn:org.stride:scenario:1");
    for (const GroupDeclaration& one : groups) write_group(writer, one, one.component);
    writer.close();
    const TemporaryFolder folder;
    const xml::Document document(folder.write("y.ssd", writer.document()), "y.ssd");
    groups = read_coverage(document.root());
  }
  REQUIRE(groups.size() == 2);
  CHECK((groups[1].component == "b" && groups[1].points.empty() && !groups[1].goal));
  const GroupDeclaration& group = groups[0];
  CHECK((group.goal == 90.5 && group.at_least == 2));
  CHECK((is_written || group.where.line == 2));
  REQUIRE(group.points.size() == 8);
  const auto& points = group.points;
  CHECK((points[0].name == "near" && points[0].subject == "d" && points[0].is_logarithmic));
  CHECK((points[0].min == 0.0 && points[0].max == 2.5 && points[0].bins == 5U));
  CHECK(points[1].edges == std::vector<double>{0, 1e-3, 1});
  CHECK((points[1].at_least == 3U && (is_written || points[1].where.line == 4)));
  CHECK((points[2].kind == PointKind::Transitions && points[2].subject == "led"));
  CHECK(points[3].words == std::vector<std::string>{"read", "write"});
  CHECK((points[4].kind == PointKind::Lengths && points[4].greatest == 20U));
  CHECK((points[5].kind == PointKind::Sequences && points[5].words.empty()));
  CHECK((points[6].shortest == std::chrono::milliseconds(1) &&
         points[6].longest == std::chrono::seconds(10)));
  CHECK(points[7].of == std::vector<std::string>{"near", "led"});
  REQUIRE(group.ignored.size() == 1);
  CHECK((group.ignored[0].points == "near" && group.ignored[0].bins == "[0, 1)"));
}

TEST_CASE("checks of coverage are beside the others") {
  const auto covered =
      read_below("Checks",
                 "<stride:Always signal='x' min='0'/>\n"
                 "<stride:Covered name='well' component='a' point='d*' min='90'/>\n"
                 "<stride:Covered component='a' min='0.5'/>\n",
                 &read_covered);
  REQUIRE(covered.size() == 2);
  CHECK((covered[0].name == "well" && covered[0].points == "d*" && covered[0].min == 90));
  CHECK((covered[1].name.empty() && !covered[1].points && covered[1].where.line == 4));
}

TEST_CASE("what is missing, unknown or no number in coverage is refused with its line") {
  CHECK_THAT(coverage_error("<stride:Values min='0'/>"), Contains("x.ssd:2") && Contains("signal"));
  CHECK_THAT(coverage_error("<stride:Values signal='d' mim='0'/>"), Contains("mim"));
  CHECK_THAT(coverage_error("<stride:Values signal='d' bins='few'/>"), Contains("few"));
  CHECK_THAT(coverage_error("<stride:Values signal='d' scale='cubic'/>"),
             Contains("expected 'linear' or 'log'"));
  CHECK_THAT(coverage_error("<stride:Values signal='d' edges='0 1' bins='3'/>"),
             Contains("edges and bins exclude each other"));
  CHECK_THAT(coverage_error("<stride:Values signal='d' atLeast='0'/>"), Contains("1 at least"));
  CHECK_THAT(coverage_error("<stride:Gaps event='f' min='2' max='1'/>"), Contains("no gap"));
  CHECK_THAT(coverage_error("<stride:Words event='f' words='read write read'/>"),
             Contains("words: 'read' is there twice"));
  CHECK_THAT(coverage_error("<stride:Colours event='f'/>"), Contains("Colours"));
  CHECK_THAT(covered_error("<stride:Covered component='a'/>"), Contains("min"));
  CHECK_THAT(covered_error("<stride:Covered component='a' min='101'/>"), Contains("from 0 to 100"));
}
