#include <catch2/catch.hpp>

#include "master/report/page_data.h"

using namespace stride::report;

TEST_CASE("no text ends the element that the JSON stands in") {
  const std::string text = json_text({{"a", "</script><!-- \\ \" \n"}, {"<b>", 1}});
  CHECK(text == R"({"a":"\u003c/script>\u003c!-- \\ \" \n","\u003cb>":1})");
  CHECK(Json::parse(text)["a"] == "</script><!-- \\ \" \n");
}

TEST_CASE("what is no UTF-8 is replaced") {
  CHECK(json_text(Json("a\xff\xc3(")) == "\"a\xEF\xBF\xBD\xEF\xBF\xBD(\"");
}
