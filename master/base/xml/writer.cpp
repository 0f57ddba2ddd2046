#include "master/base/xml/writer.h"

#include <string_view>

#include <tinyxml2.h>

#include "master/base/text/readable_text.h"

namespace stride::xml {
namespace {

/// Char of XML 1.0; surrogates are no characters of UTF-8.
bool is_allowed(std::string_view character) {
  constexpr std::string_view kAllowedControls = "\t\n\r";
  const auto first = static_cast<unsigned char>(character[0]);
  if (first < ' ') return kAllowedControls.find(character) != std::string_view::npos;
  return character != "\uFFFE" && character != "\uFFFF";
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::string_view character = core::take_character(text);
    result += is_allowed(character) ? character : core::kReplacement;
  }
  return result;
}

}  // namespace

Writer::Writer() : printer_(std::make_unique<tinyxml2::XMLPrinter>()) {
  printer_->PushDeclaration("xml version=\"1.0\" encoding=\"UTF-8\"");
}

Writer::~Writer() = default;

void Writer::open(const char* name) { printer_->OpenElement(name); }

void Writer::attribute(const char* name, const std::string& value) {
  printer_->PushAttribute(name, printable(value).c_str());
}

void Writer::text(const std::string& text) { printer_->PushText(printable(text).c_str()); }

void Writer::close() { printer_->CloseElement(); }

std::string Writer::document() const { return printer_->CStr(); }

}  // namespace stride::xml
