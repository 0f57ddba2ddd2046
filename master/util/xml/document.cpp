#include "master/util/xml/document.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "master/util/input_file.h"
#include "master/util/xml/character_references.h"
#include "master/util/xml/editor.h"

namespace stride::xml {
namespace {

/// The encoding that the XML declaration names, in small letters; UTF-8 if it names none.
std::string declared_encoding(const std::string& text) {
  const std::string_view head = std::string_view(text).substr(0, text.find("?>"));
  const std::size_t name = head.find("encoding");
  const std::size_t begin = name == head.npos ? head.npos : head.find_first_of("'\"", name);
  if (!head.starts_with("<?xml") || begin == head.npos) return "utf-8";
  const std::size_t end = head.find(head[begin], begin + 1);
  std::string encoding(head.substr(begin + 1, end == head.npos ? end : end - begin - 1));
  std::transform(encoding.begin(), encoding.end(), encoding.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return encoding;
}

const char* words_for(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element without its end tag, or an end tag without its element";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "a malformed or doubled attribute";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "a malformed tag";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment without its end";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "a CDATA section without its end";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "a declaration that is malformed or in the wrong place";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "the file holds nothing";
    default:
      return "text where a tag is expected";
  }
}

[[noreturn]] void fail(const std::string& file, const std::string& message,
                       const std::string& hint = "") {
  core::fail_input({.where = {file, 0}}, message, hint);
}

void check_encoding(const std::string& text, const std::string& file) {
  if (text.starts_with("PK\x03\x04")) {
    fail(file, "this is a packed archive (such as .ssp or .fmu), expected an XML file",
         "unpack it, and name the SystemStructure.ssd inside it");
  }
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
      text.find('\0') != std::string::npos) {
    fail(file, "this is not valid UTF-8 text", "save it as XML with the encoding UTF-8");
  }
  const std::string encoding = declared_encoding(text);
  if (encoding != "utf-8" && encoding != "us-ascii") {
    fail(file, fmt::format("the encoding '{}' is not read", encoding),
         "save it as XML with the encoding UTF-8");
  }
}

/// The time of tinyxml2 is quadratic in their number.
void check_attributes(const std::string& text, const std::string& file) {
  constexpr std::size_t kMostAttributes = 1000;
  for (TagScanner tags(text); tags.next();) {
    if (tags.quoted() <= kMostAttributes) continue;
    const auto line =
        1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(tags.begin()), '\n');
    core::fail_input({.where = {file, static_cast<int>(line)}},
                     fmt::format("an element with {} attributes; {} at most are read",
                                 tags.quoted(), kMostAttributes));
  }
}

/// tinyxml2 takes those of no character as text, and NUL for the end of it.
void check_references(const std::string& text, const std::string& file) {
  const auto bad = find_bad_reference(text);
  if (!bad) return;
  const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(*bad), '\n');
  constexpr std::size_t kMost = 12;
  const std::string reference = text.substr(*bad, text.find(';', *bad) + 1 - *bad);
  core::fail_input({.where = {file, static_cast<int>(line)}},
                   fmt::format("this is not well-formed XML: '{}' is no character of XML",
                               reference.size() <= kMost ? reference : reference.substr(0, kMost)),
                   "write the character itself, or a reference to another one");
}

/// tinyxml2 takes </a/> for an element, so it finds more of them than there are.
std::size_t count_elements(const tinyxml2::XMLNode& node) {
  std::size_t count = node.ToElement() != nullptr ? 1 : 0;
  for (const auto* child = node.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    count += count_elements(*child);
  }
  return count;
}

}  // namespace

struct Document::Content {
  std::string file;
  std::string text;
  tinyxml2::XMLDocument document;
};

Document::Document(const std::filesystem::path& path, const std::string& shown_as)
    : Document(
          parse(core::read_input(path, shown_as), shown_as.empty() ? path.string() : shown_as)) {}

Document::Document(std::unique_ptr<Content> content) : content_(std::move(content)) {}
Document::~Document() = default;
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;

Document Document::parse(std::string text, const std::string& shown_as) {
  check_encoding(text, shown_as);
  check_attributes(text, shown_as);
  check_references(text, shown_as);
  auto content = std::make_unique<Content>();
  content->file = shown_as;
  content->text = std::move(text);
  tinyxml2::XMLDocument& document = content->document;
  if (document.Parse(content->text.data(), content->text.size()) != tinyxml2::XML_SUCCESS) {
    if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
      core::fail_input({.where = {shown_as, document.ErrorLineNum()}},
                       "more than 100 elements inside each other, which is not read");
    }
    core::fail_input({.where = {shown_as, document.ErrorLineNum()}},
                     fmt::format("this is not well-formed XML: {}", words_for(document.ErrorID())),
                     "look for a missing end tag or quotation mark in or above this line");
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (root == nullptr) fail(shown_as, "the file holds no XML element");
  if (const auto* second = root->NextSiblingElement()) {
    Element(*second, shown_as).fail(fmt::format("a second root element <{}>", second->Name()));
  }
  if (count_elements(document) != element_places(content->text).size()) {
    fail(shown_as, "this is not well-formed XML: there is an end tag with a '/' at its end",
         "write </name> to end an element, and <name/> for an empty one");
  }
  return Document(std::move(content));
}

const std::string& Document::text() const { return content_->text; }

Element Document::root() const { return {*content_->document.RootElement(), content_->file}; }

}  // namespace stride::xml
