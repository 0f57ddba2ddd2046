#include "units/channel/tag_list.h"

#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace {

using Names = std::vector<std::string>;

Names read(const std::string& text) {
  return channel::parse_tag_list(text, "channel.xml", "nfc-channel");
}

}  // namespace

TEST_CASE("The tags are listed in the order of the file") {
  CHECK(read("<nfc-channel version=\"1\"><!-- two -->\n<tag name=\"window\"/><tag name=\"_door2\"/>"
             "</nfc-channel>") == Names{"window", "_door2"});
}

TEST_CASE("Mistakes are reported with file and line") {
  const auto [text, line, message] = GENERATE(table<std::string, std::string, std::string>({
      {"<nfc-channel version=\"1\">\n<tag name=\"a\">", "channel.xml:", "expected well-formed XML"},
      {"", "channel.xml:", "expected well-formed XML"},
      {"<!-- nothing -->", "channel.xml:1", "expected <nfc-channel>"},
      {"\n<channel version=\"1\"/>", "channel.xml:2", "expected <nfc-channel>"},
      {"<nfc-channel/>", "channel.xml:1", "expected the attribute 'version'"},
      {"<nfc-channel version=\"2\"/>", "channel.xml:1", "is not known: expected 1"},
      {"<nfc-channel version=\"1\"/>", "channel.xml:1", "expected one at least"},
      {"<nfc-channel version=\"1\" x=\"\"/>", "channel.xml:1", "unknown attribute 'x'"},
      {"<nfc-channel version=\"1\">\n<tag/></nfc-channel>", "channel.xml:2",
       "expected the attribute 'name'"},
      {"<nfc-channel version=\"1\">\n<tag name=\"a\" radius=\"1\"/></nfc-channel>", "channel.xml:2",
       "unknown attribute 'radius'"},
      {"<nfc-channel version=\"1\">\n\n<sensor name=\"a\"/></nfc-channel>", "channel.xml:3",
       "expected nothing but <tag"},
      {"<nfc-channel version=\"1\">text</nfc-channel>", "channel.xml:1", "expected no text"},
      {"<nfc-channel version=\"1\">\n<tag name=\"a\"><b/></tag></nfc-channel>", "channel.xml:2",
       "expected no element inside <tag>"},
      {"<nfc-channel version=\"1\">\n<tag name=\"2a\"/></nfc-channel>", "channel.xml:2",
       "no digit first"},
      {"<nfc-channel version=\"1\">\n<tag name=\"\"/></nfc-channel>", "channel.xml:2",
       "expected letters"},
      {"<nfc-channel version=\"1\">\n<tag name=\"a.b\"/></nfc-channel>", "channel.xml:2",
       "expected letters"},
      {"<nfc-channel version=\"1\">\n<tag name=\"reader\"/></nfc-channel>", "channel.xml:2",
       "the channel itself uses it"},
      {"<nfc-channel version=\"1\">\n<tag name=\"a\"/>\n<tag name=\"a\"/></nfc-channel>",
       "channel.xml:3", "expected another one"},
  }));
  INFO(text);
  CHECK_THROWS_WITH(read(text), Catch::Contains(line) && Catch::Contains(message));
}

TEST_CASE("A file that is not there is named") {
  CHECK_THROWS_WITH(channel::read_tag_list("/nowhere/channel.xml", "nfc-channel"),
                    Catch::Contains("/nowhere/channel.xml"));
}
