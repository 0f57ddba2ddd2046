#include "units/ground_truth/quantity.h"

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <tinyxml2.h>

namespace ground_truth {
namespace {

constexpr const char* kForm = R"(<quantity version="1" unit="degC" difference="K"/>)";

[[noreturn]] void fail(const std::string& file, int line, const std::string& message) {
  throw std::runtime_error(file + ":" + std::to_string(line) + ": " + message + ", such as " +
                           kForm);
}

std::string text(const tinyxml2::XMLElement& element, const char* attribute,
                 const std::string& file) {
  const char* const value = element.Attribute(attribute);
  if (value != nullptr) return value;
  fail(file, element.GetLineNum(),
       "<quantity>: expected the attribute '" + std::string(attribute) + "'");
}

void check_attributes(const tinyxml2::XMLElement& element, const std::string& file) {
  for (const auto* a = element.FirstAttribute(); a != nullptr; a = a->Next()) {
    const std::string_view name = a->Name();
    if (name == "version" || name == "unit" || name == "difference") continue;
    fail(file, element.GetLineNum(),
         "unknown attribute '" + std::string(name) +
             "' of <quantity>: expected 'version', 'unit' and 'difference'");
  }
}

}  // namespace

Quantity read_quantity(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, 0, "cannot be opened: expected the quantity that is compared");
  std::ostringstream text;
  text << stream.rdbuf();
  return parse_quantity(text.str(), file);
}

Quantity parse_quantity(const std::string& content, const std::string& file) {
  tinyxml2::XMLDocument document;
  if (document.Parse(content.data(), content.size()) != tinyxml2::XML_SUCCESS) {
    fail(file, document.ErrorLineNum(),
         "cannot be read as XML (" + std::string(document.ErrorStr()) + "): expected a file");
  }
  const tinyxml2::XMLElement* const root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "quantity") {
    fail(file, root == nullptr ? 1 : root->GetLineNum(), "expected <quantity> as the root");
  }
  check_attributes(*root, file);
  if (text(*root, "version", file) != "1") {
    fail(file, root->GetLineNum(), "<quantity>: expected version=\"1\"");
  }
  if (!root->NoChildren()) fail(file, root->GetLineNum(), "expected nothing in <quantity>");
  return {text(*root, "unit", file), text(*root, "difference", file)};
}

}  // namespace ground_truth
