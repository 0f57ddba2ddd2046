#include "units/channel/tag_list.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "units/xml/document.h"

namespace channel {
namespace {

constexpr std::array<std::string_view, 7> kReserved = {
    "reader", "reader_coil", "from_reader", "to_reader", "carrier_power", "seed", "time"};

bool is_identifier(const std::string& name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || is_digit(c); });
}

void require_name(const xml::Element& tag, const std::string& name,
                  const std::vector<std::string>& before) {
  if (!is_identifier(name)) {
    tag.fail("name=\"" + name + "\": expected letters, digits and _, no digit first");
  }
  if (std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end()) {
    tag.fail("name=\"" + name + "\": the channel itself uses it; expected another name");
  }
  if (std::find(before.begin(), before.end(), name) != before.end()) {
    tag.fail("name=\"" + name + "\": a tag before has this name; expected another one");
  }
}

std::vector<std::string> names_in(const xml::Element& root) {
  std::vector<std::string> names;
  for (const xml::Element& tag : root.children()) {
    if (tag.name() != "tag") tag.fail("expected nothing but <tag name=\"...\"/> here");
    tag.allow_only_leaf({"name"});
    const std::string name = tag.text("name");
    require_name(tag, name, names);
    names.push_back(name);
  }
  if (names.empty()) root.fail("there is no tag: expected one at least");
  return names;
}

}  // namespace

std::vector<std::string> read_tag_list(const std::string& file, const std::string& root) {
  return names_in(xml::Document::load(file, root).root());
}

std::vector<std::string> parse_tag_list(const std::string& text, const std::string& file,
                                        const std::string& root) {
  return names_in(xml::Document::parse(text, file, root).root());
}

}  // namespace channel
