#include "master/base/xml/document.h"

#include <algorithm>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "master/base/files/input_file.h"
#include "master/base/xml/character_references.h"
#include "master/base/xml/editor.h"
#include "master/base/xml/encoding.h"
#include "master/base/xml/tag_mistake.h"

namespace stride::xml {
namespace {

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

DecodedText decode_text(std::string bytes, const std::string& file) {
  if (bytes.starts_with("PK\x03\x04")) {
    fail(file, "this is a packed archive (such as .ssp or .fmu), expected an XML file",
         "unpack it, and name the SystemStructure.ssd inside it");
  }
  if (core::begins_as_lfs_pointer(bytes)) {
    fail(file, fmt::format("this is {}, expected an XML file", core::kLfsPointer), core::kLfsHint);
  }
  return decode(std::move(bytes), file);
}

/// Some tools write them behind the end of a document; elsewhere they are an error.
void strip_nuls(std::string& text, const std::string& file, std::vector<std::string>& warnings) {
  constexpr std::string_view kFill("\0 \t\r\n", 5);
  const std::size_t first = text.find('\0');
  if (first == std::string::npos) return;
  if (first == 0 || text.find_first_not_of(kFill, first) != std::string::npos) {
    fail(file, "there is a NUL character in it, which no XML file has",
         "save it as XML with the encoding UTF-8");
  }
  text.erase(first);
  warnings.push_back(core::to_text({.where = {file, 0}}) +
                     "NUL characters behind its end are ignored");
}

/// With blanks in place of the processing instructions between two tags.
void blank_instructions(std::string& text, std::size_t begin, std::size_t end) {
  while ((begin = text.find('<', begin)) < end) {
    const std::size_t behind = markup_end(text, begin);
    const std::string_view markup(&text[begin], behind - begin);
    const bool is_declaration = markup.starts_with("<?xml") && markup.find_first_of(" \t\r\n") == 5;
    if (markup.starts_with("<?") && markup.ends_with("?>") && !is_declaration) {
      std::replace_if(
          &text[begin], &text[behind], [](char c) { return c != '\n'; }, ' ');
    }
    begin = behind;
  }
}

/// tinyxml2 takes processing instructions for declarations, which it reads at the beginning only.
std::string without_instructions(std::string text) {
  if (text.find("<?", 1) == text.npos) return text;
  std::size_t behind = 0;
  for (TagScanner tags(text); behind < text.size(); behind = tags.end()) {
    const bool is_tag = tags.next();
    blank_instructions(text, behind, is_tag ? tags.begin() : text.size());
    if (!is_tag) break;
  }
  return text;
}

core::Context place_of(std::size_t position, const std::string& text, const std::string& file) {
  return {.where = {file, line_at(text, position)}};
}

/// The time of tinyxml2 is quadratic in their number.
void check_attributes(const std::string& text, const std::string& file) {
  constexpr std::size_t kMostAttributes = 1000;
  for (TagScanner tags(text); tags.next();) {
    if (tags.quoted() <= kMostAttributes) continue;
    core::fail_input(place_of(tags.begin(), text, file),
                     fmt::format("an element with {} attributes; {} at most are read",
                                 tags.quoted(), kMostAttributes));
  }
}

/// tinyxml2 takes those of no character as text, as it does entities, and NUL for the end of it.
void check_references(const std::string& text, const std::string& file) {
  const auto bad = find_bad_reference(text);
  if (!bad) return;
  constexpr std::size_t kMost = 12;
  const std::string reference = text.substr(*bad, text.find(';', *bad) + 1 - *bad);
  const std::string shown = reference.size() <= kMost ? reference : reference.substr(0, kMost);
  const core::Context place = place_of(*bad, text, file);
  if (reference.starts_with("&#")) {
    core::fail_input(place,
                     fmt::format("this is not well-formed XML: '{}' is no character of XML", shown),
                     "write the character itself, or a reference to another one");
  }
  core::fail_input(place,
                   fmt::format("'{}' is an entity that only a document type definition (DTD) could "
                               "define, and these are not read",
                               shown),
                   "write what it stands for; '&' itself is '&amp;'");
}

void check_characters(const std::string& text, const std::string& file) {
  const auto bad = find_bad_character(text);
  if (!bad) return;
  core::fail_input(place_of(*bad, text, file),
                   fmt::format("this is not well-formed XML: the control character \\x{:02x} is no "
                               "character of XML",
                               static_cast<unsigned char>(text[*bad])),
                   "leave it out");
}

/// The mistake in the tags that tinyxml2 has met, if it is one. It names the line of the start tag
/// where an end tag is wrong, and the last tag that it has read where the text ends too early.
std::optional<TagMistake> tag_mistake_at(const tinyxml2::XMLDocument& document,
                                         const std::string& text) {
  const tinyxml2::XMLError error = document.ErrorID();
  const bool is_in_no_tag = error == tinyxml2::XML_ERROR_PARSING_COMMENT ||
                            error == tinyxml2::XML_ERROR_PARSING_CDATA ||
                            error == tinyxml2::XML_ERROR_PARSING_DECLARATION ||
                            error == tinyxml2::XML_ERROR_PARSING_UNKNOWN;
  if (is_in_no_tag) return std::nullopt;
  auto mistake = find_tag_mistake(text);
  const bool is_in_one_tag = error == tinyxml2::XML_ERROR_PARSING_ELEMENT ||
                             error == tinyxml2::XML_ERROR_PARSING_ATTRIBUTE;
  const bool is_later = mistake && line_at(text, mistake->position) > document.ErrorLineNum();
  if (is_in_one_tag && is_later) return std::nullopt;
  return mistake;
}

[[noreturn]] void fail_to_parse(const tinyxml2::XMLDocument& document, const std::string& text,
                                const std::string& file) {
  const core::Context place{.where = {file, document.ErrorLineNum()}};
  if (document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED) {
    core::fail_input(place, "more than 100 elements inside each other, which is not read");
  }
  const std::string message = "this is not well-formed XML: ";
  if (const auto mistake = tag_mistake_at(document, text)) {
    core::fail_input(place_of(mistake->position, text, file), message + mistake->reason,
                     mistake->hint);
  }
  core::fail_input(place, message + words_for(document.ErrorID()),
                   "look for a missing end tag or quotation mark in or above this line");
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

/// The first element whose name begins so, and that is in none with this attribute.
const tinyxml2::XMLElement* find_undeclared(const tinyxml2::XMLElement& below,
                                            const std::string& begin,
                                            const std::string& attribute) {
  if (below.Attribute(attribute.c_str()) != nullptr) return nullptr;
  if (std::string_view(below.Name()).starts_with(begin)) return &below;
  for (const auto* child = below.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (const auto* found = find_undeclared(*child, begin, attribute)) return found;
  }
  return nullptr;
}

/// Whether a tool that writes this means the namespace: with https, or with a '/' at its end.
bool means(std::string_view written, std::string_view name_space) {
  constexpr std::string_view kSecure = "https://";
  constexpr std::string_view kPlain = "http://";
  std::string plain = without_blanks(written);
  if (plain.ends_with('/')) plain.pop_back();
  if (plain.starts_with(kSecure)) plain.replace(0, kSecure.size(), kPlain);
  return plain == name_space && written != name_space;
}

}  // namespace

struct Document::Content {
  std::string file;
  std::string text;
  std::vector<std::string> warnings;
  tinyxml2::XMLDocument document;
};

/// Puts the namespace in place of what means it, in the element and all below it.
void Document::respell(const Prefix& prefix, tinyxml2::XMLElement& below, Content& content) {
  for (const auto* own = below.FirstAttribute(); own != nullptr; own = own->Next()) {
    const std::string name = own->Name();
    const bool declares = name == "xmlns" || name.starts_with("xmlns:");
    if (!declares || !means(own->Value(), prefix.name_space)) continue;
    content.warnings.push_back(
        core::to_text({.where = {content.file, below.GetLineNum()}}) +
        fmt::format("{}=\"{}\" is taken for {}", name, own->Value(), prefix.name_space));
    below.SetAttribute(name.c_str(), prefix.name_space);
  }
  for (auto* child = below.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    respell(prefix, *child, content);
  }
}

/// Where it is used without a declaration, the root gets one.
void Document::declare(const Prefix& prefix, tinyxml2::XMLElement& root, Content& content) {
  const std::string attribute = fmt::format("xmlns:{}", prefix.name);
  if (root.Attribute(attribute.c_str()) != nullptr) return;
  const std::string begin = fmt::format("{}:", prefix.name);
  const auto* const user = find_undeclared(root, begin, attribute);
  if (user == nullptr) return;
  content.warnings.push_back(
      core::to_text({.where = {content.file, user->GetLineNum()}}) +
      fmt::format("the prefix '{}' of <{}> is not declared; it is taken for {}", prefix.name,
                  user->Name(), prefix.name_space));
  root.SetAttribute(attribute.c_str(), prefix.name_space);
}

Document::Document(const std::filesystem::path& path, const std::string& shown_as,
                   std::span<const Prefix> known)
    : Document(parse(core::read_input(path, shown_as), shown_as.empty() ? path.string() : shown_as,
                     known)) {}

Document::Document(std::unique_ptr<Content> content) : content_(std::move(content)) {}
Document::~Document() = default;
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;

Document Document::parse(std::string bytes, const std::string& shown_as,
                         std::span<const Prefix> known) {
  auto content = std::make_unique<Content>();
  content->file = shown_as;
  DecodedText decoded = decode_text(std::move(bytes), shown_as);
  if (!decoded.warning.empty()) content->warnings.push_back(std::move(decoded.warning));
  content->text = std::move(decoded.text);
  strip_nuls(content->text, shown_as, content->warnings);
  const std::string& text = content->text;
  check_attributes(text, shown_as);
  check_characters(text, shown_as);
  check_references(text, shown_as);
  tinyxml2::XMLDocument& document = content->document;
  const std::string parsed = without_instructions(text);
  if (document.Parse(parsed.data(), parsed.size()) != tinyxml2::XML_SUCCESS) {
    fail_to_parse(document, text, shown_as);
  }
  tinyxml2::XMLElement* const root = document.RootElement();
  if (root == nullptr) fail(shown_as, "the file holds no XML element");
  if (const auto* second = root->NextSiblingElement()) {
    Element(*second, shown_as).fail(fmt::format("a second root element <{}>", second->Name()));
  }
  if (count_elements(document) != element_places(text).size()) {
    fail(shown_as, "this is not well-formed XML: there is an end tag with a '/' at its end",
         "write </name> to end an element, and <name/> for an empty one");
  }
  for (const Prefix& prefix : known) {
    respell(prefix, *root, *content);
    declare(prefix, *root, *content);
  }
  return Document(std::move(content));
}

const std::string& Document::text() const { return content_->text; }

const std::vector<std::string>& Document::warnings() const { return content_->warnings; }

Element Document::root() const { return {*content_->document.RootElement(), content_->file}; }

}  // namespace stride::xml
