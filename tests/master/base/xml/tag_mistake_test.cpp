#include "master/base/xml/tag_mistake.h"

#include <string>

#include <catch2/catch.hpp>

using namespace stride;

namespace {

/// "LINE: REASON | HINT"
std::string mistake_in(const std::string& text) {
  const auto mistake = xml::find_tag_mistake(text);
  if (!mistake) return "none";
  return std::to_string(xml::line_at(text, mistake->position)) + ": " + mistake->reason + " | " +
         mistake->hint;
}

}  // namespace

TEST_CASE("Tags that belong together are no mistake") {
  CHECK(mistake_in("<a x='>'><!-- </b> --><b y=\"'\"/><![CDATA[<c>]]>\n<a></a ></a>") == "none");
  CHECK(mistake_in("") == "none");
  CHECK(mistake_in("text") == "none");
}

TEST_CASE("A wrong end tag is named with the element that is open, and both lines") {
  CHECK(mistake_in("<a>\n<b>\n<c/>\n</d>\n</a>") ==
        "4: </d> ends no element; the open one is <b> of line 2 | did you mean </b>?");
  CHECK(mistake_in("<a>\n<b>\n<c>\n</b>\n</a>") ==
        "4: </b>, which ends the element of line 2, before the end tag of <c> of line 3 | write "
        "</c> before it");
  CHECK(mistake_in("<a>\n</a>\n</b>") ==
        "3: </b> ends no element, since all have ended | leave it out, or write the start tag that "
        "belongs to it");
}

TEST_CASE("The end of the text within an element is named with the element") {
  CHECK(mistake_in("<a>\n<b>\n<c/>\n\n") ==
        "3: the file ends before the end tag of <b> of line 2 | it may have been cut off: 2 "
        "elements have no end tag");
  CHECK(mistake_in("<a>\n<b/>") ==
        "2: the file ends before the end tag of <a> of line 1 | write </a> at its end");
}

TEST_CASE("The end of the text within a tag is named with the tag") {
  constexpr const char* kHint = " | it may have been cut off";
  CHECK(mistake_in("<a>\n<b x='1' y='") ==
        std::string("2: the file ends within the tag <b") + kHint);
  CHECK(mistake_in("<a>\n<b x='>") == std::string("2: the file ends within the tag <b") + kHint);
  CHECK(mistake_in("<a>\n</a") == std::string("2: the file ends within the tag </a") + kHint);
  CHECK(mistake_in("<a>\n<") == std::string("2: the file ends within the tag <") + kHint);
}

TEST_CASE("A missing quotation mark or '>' is named where its tag is") {
  CHECK(mistake_in("<a>\n<b\nx='1/>\n<c y='2'/></a>") ==
        "3: a '<' in the value of an attribute of <b> | a quotation mark may be missing behind the "
        "value; '<' itself is '&lt;'");
  CHECK(mistake_in("<a>\n<b x='1'\n<c/></a>") ==
        "2: the tag <b has no '>' | write it before the next '<'");
  CHECK(mistake_in("<a>\n</b\n</a>") == "2: the tag </b has no '>' | write it before the next '<'");
}
