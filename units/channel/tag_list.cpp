#include "units/channel/tag_list.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <tinyxml2.h>

namespace channel {
namespace {

constexpr std::array<std::string_view, 7> kReserved = {
    "reader", "reader_coil", "from_reader", "to_reader", "carrier_power", "seed", "time"};

[[noreturn]] void fail(const std::string& file, int line, const std::string& message) {
  throw std::runtime_error(file + ":" + std::to_string(line) + ": " + message);
}

bool is_identifier(const std::string& name) {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && is_letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return is_letter(c) || is_digit(c); });
}

void require_attribute(const tinyxml2::XMLElement& element, const std::string& file,
                       std::string_view only) {
  for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    if (a->Name() != only) {
      fail(file, element.GetLineNum(),
           "unknown attribute '" + std::string(a->Name()) + "' of <" + element.Name() +
               ">: expected '" + std::string(only) + "'");
    }
  }
  if (element.Attribute(std::string(only).c_str()) == nullptr) {
    fail(file, element.GetLineNum(),
         "<" + std::string(element.Name()) + ">: expected the attribute '" + std::string(only) +
             "'");
  }
}

void require_name(const tinyxml2::XMLElement& tag, const std::string& file, const std::string& name,
                  const std::vector<std::string>& before) {
  const int line = tag.GetLineNum();
  if (!is_identifier(name)) {
    fail(file, line, "name=\"" + name + "\": expected letters, digits and _, no digit first");
  }
  if (std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end()) {
    fail(file, line, "name=\"" + name + "\": the channel itself uses it; expected another name");
  }
  if (std::find(before.begin(), before.end(), name) != before.end()) {
    fail(file, line, "name=\"" + name + "\": a tag before has this name; expected another one");
  }
}

}  // namespace

std::vector<std::string> read_tag_list(const std::string& file, const std::string& root) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, 0, "cannot be opened");
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_tag_list(text.str(), file, root);
}

std::vector<std::string> parse_tag_list(const std::string& text, const std::string& file,
                                        const std::string& expected_root) {
  const std::string element = "<" + expected_root + ">";
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    fail(file, document.ErrorLineNum(),
         "cannot be read as XML: " + std::string(document.ErrorStr()));
  }
  if (document.RootElement() == nullptr) fail(file, 1, "is empty: expected " + element);
  const auto& root = *document.RootElement();
  if (root.Name() != expected_root) {
    fail(file, root.GetLineNum(),
         "the root element is <" + std::string(root.Name()) + ">: expected " + element);
  }
  require_attribute(root, file, "version");
  if (std::string_view(root.Attribute("version")) != "1") {
    fail(file, root.GetLineNum(), element + ": expected version=\"1\"");
  }

  std::vector<std::string> names;
  for (const auto* node = root.FirstChild(); node != nullptr; node = node->NextSibling()) {
    if (node->ToComment() != nullptr) continue;
    const auto* tag = node->ToElement();
    if (tag == nullptr || std::string_view(tag->Name()) != "tag" || !tag->NoChildren()) {
      fail(file, node->GetLineNum(), "expected nothing but <tag name=\"...\"/> in " + element);
    }
    require_attribute(*tag, file, "name");
    const std::string name = tag->Attribute("name");
    require_name(*tag, file, name, names);
    names.push_back(name);
  }
  if (names.empty()) fail(file, root.GetLineNum(), "there is no tag: expected one at least");
  return names;
}

}  // namespace channel
