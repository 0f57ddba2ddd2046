#include "master/system/declaration/check_declaration.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::scenario;
using namespace stride::tests;
using Catch::Contains;
using checks::Kind;
using std::chrono::milliseconds;

namespace {

/// The elements begin in line 2.
std::vector<CheckDeclaration> read_declarations(const std::string& elements) {
  const TemporaryFolder folder;
  const auto file =
      folder.write("x.ssd", "<stride:Checks xmlns:stride='urn:org.stride:scenario:1'>\n" +
                                elements + "</stride:Checks>");
  const xml::Document document(file, "x.ssd");
  return read_checks(document.root());
}

std::string declaration_error(const std::string& element) {
  return error_of([&] { read_declarations(element); });
}

}  // namespace

TEST_CASE("the checks in their order, with their lines") {
  const auto checks = read_declarations(
      "<stride:Always signal='a.v' min='1.8' max='5' from='8' to='20' name='supply'/>\n"
      "<stride:Never signal='a.v' above='1' below='2'/>\n"
      "<stride:Eventually signal='a.led' equals='true' to='1e-3'/>\n"
      "<stride:Final signal='a.v' equals='3' tolerance='0.1'/>\n"
      "<stride:Count event='a.frame' min='1' max='3' from='1'/>\n"
      "<stride:Count event='a.frame' equals='2'/>\n"
      "<stride:Answer request='r.frame' reply='a.frame' within='0.01' repeats='true' to='4'/>\n"
      "<stride:Until signal='a.led' equals='false' to='4'>\n"
      "  <stride:Condition signal='b.v' above='3'/></stride:Until>");
  REQUIRE(checks.size() == 8);
  CHECK((checks[7].kind == Kind::Until && checks[7].subject == "a.led"));
  CHECK((checks[7].condition.equals == "false" && checks[7].window.to == Time(milliseconds(4000))));
  CHECK((checks[7].ending_signal == "b.v" && checks[7].ending.above == "3"));
  CHECK((checks[0].kind == Kind::Always && checks[0].name == "supply"));
  CHECK(checks[0].subject == "a.v");
  CHECK((checks[0].condition.min == "1.8" && checks[0].condition.max == "5"));
  CHECK(checks[0].window.from == Time(milliseconds(8000)));
  CHECK(checks[0].window.to == Time(milliseconds(20000)));
  CHECK((checks[1].kind == Kind::Never && checks[1].condition.above == "1"));
  CHECK((checks[1].condition.below == "2" && checks[1].name.empty() && checks[1].where.line == 3));
  CHECK((checks[2].kind == Kind::Eventually && checks[2].condition.equals == "true"));
  CHECK((!checks[2].window.from && checks[2].window.to == Time(milliseconds(1))));
  CHECK((checks[3].kind == Kind::Final && checks[3].condition.tolerance == "0.1"));
  CHECK((checks[4].kind == Kind::Count && checks[4].min == 1U && checks[4].max == 3U));
  CHECK((checks[5].min == 2U && checks[5].max == 2U));
  CHECK((checks[6].kind == Kind::Answer && checks[6].subject == "r.frame"));
  CHECK((checks[6].reply == "a.frame" && checks[6].repeats));
  CHECK((checks[6].within == milliseconds(10) && checks[6].where.line == 8));
}

TEST_CASE("what is written wrongly is refused, with its line") {
  CHECK(read_declarations("").empty());
  CHECK_THAT(declaration_error("\n<stride:Range signal='a.v' min='0'/>"),
             Contains("x.ssd:3: ") && Contains("Range"));
  CHECK_THAT(declaration_error("<stride:Always min='0'/>"),
             Contains("x.ssd:2: ") && Contains("signal"));
  CHECK_THAT(declaration_error("<stride:Always signal='a' mim='0'/>"), Contains("mim"));
  CHECK_THAT(declaration_error("<stride:Always signal='a' from='2' to='1'/>"),
             Contains("the interval ends at 1 s, before it begins at 2 s"));
  CHECK_THAT(declaration_error("<stride:Always signal='a' from='soon'/>"),
             Contains("from: 'soon'"));
  CHECK_THAT(declaration_error("<stride:Always signal='a' to='nan'/>"), Contains("to: 'nan'"));
  CHECK_THAT(declaration_error("<stride:Always signal='a' name=''/>"), Contains("name"));
  CHECK_THAT(declaration_error("<stride:Always signal='a' max='1' name='a&#10;b'/>"),
             Contains("'name' of <stride:Always> has more than one line"));
  CHECK_THAT(declaration_error("<stride:Final signal='a' equals='1' from='1'/>"), Contains("from"));
  CHECK_THAT(declaration_error("<stride:Until signal='a' min='1'/>"),
             Contains("x.ssd:2: ") && Contains("it has no <stride:Condition signal="));
  CHECK_THAT(declaration_error("<stride:Until signal='a' min='1'><stride:Condition signal='b' "
                               "equals='1'/><stride:Condition signal='c' equals='1'/>"
                               "</stride:Until>"),
             Contains("Condition"));
  CHECK_THAT(declaration_error("<stride:Always signal='a' min='1'><stride:Condition signal='b' "
                               "equals='1'/></stride:Always>"),
             Contains("Condition"));
  CHECK_THAT(declaration_error("<stride:Count event='a'/>"),
             Contains("expected min, max or equals"));
  CHECK_THAT(declaration_error("<stride:Count event='a' min='-1'/>"), Contains("min"));
  CHECK_THAT(declaration_error("<stride:Count event='a' min='1.5'/>"), Contains("min"));
  CHECK_THAT(declaration_error("<stride:Count event='a' equals='1' max='2'/>"),
             Contains("exclude each other"));
  CHECK_THAT(declaration_error("<stride:Count event='a' min='3' max='2'/>"),
             Contains("no count is 3 at least and 2 at most"));
  CHECK_THAT(declaration_error("<stride:Answer request='a' reply='b'/>"), Contains("within"));
  CHECK_THAT(declaration_error("<stride:Answer request='a' within='1'/>"), Contains("reply"));
  CHECK_THAT(declaration_error("<stride:Answer request='a' reply='b' within='-1'/>"),
             Contains("within: '-1'"));
  CHECK_THAT(declaration_error("<stride:Answer request='a' reply='b' within='1' repeats='yes'/>"),
             Contains("repeats"));
}
