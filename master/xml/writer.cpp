#include "master/xml/writer.h"

#include <algorithm>

#include <tinyxml2.h>

namespace stride::xml {
namespace {

std::string printable(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < ' ' && c != '\t' && c != '\n' && c != '\r'; }, '?');
  return text;
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
