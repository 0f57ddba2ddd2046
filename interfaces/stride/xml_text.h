// Texts as values of attributes in XML.
#ifndef STRIDE_XML_TEXT_H
#define STRIDE_XML_TEXT_H

#include <string>
#include <string_view>

namespace stride {

/// Appends a byte of a text in UTF-8, so that it is read back within quotation marks: markup,
/// quotation marks, tabs and line ends as references, which a reader does not normalise. Other
/// control characters cannot be written in XML 1.0, and are appended as they are.
inline void append_xml_character(std::string& text, char c) {
  switch (c) {
    case '&':
      text += "&amp;";
      break;
    case '<':
      text += "&lt;";
      break;
    case '>':
      text += "&gt;";
      break;
    case '"':
      text += "&quot;";
      break;
    case '\n':
      text += "&#10;";
      break;
    case '\r':
      text += "&#13;";
      break;
    case '\t':
      text += "&#9;";
      break;
    default:
      text += c;
  }
}

/// A whole text likewise.
inline std::string xml_escaped(std::string_view value) {
  std::string text;
  text.reserve(value.size());
  for (const char c : value) append_xml_character(text, c);
  return text;
}

}  // namespace stride

#endif
