#include "master/io/xml.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include <fmt/format.h>
#include <tinyxml2.h>

#include "master/core/suggest.h"

namespace stride::io {
namespace {

bool starts_with(std::string_view text, std::string_view head) {
  return text.substr(0, head.size()) == head;
}

std::string_view prefix(std::string_view qualified) {
  const std::size_t colon = qualified.find(':');
  return colon == std::string_view::npos ? std::string_view{} : qualified.substr(0, colon);
}

std::string_view local(std::string_view qualified) {
  const std::size_t colon = qualified.find(':');
  return colon == std::string_view::npos ? qualified : qualified.substr(colon + 1);
}

const tinyxml2::XMLElement* parent_element(const tinyxml2::XMLElement* element) {
  return element->Parent() == nullptr ? nullptr : element->Parent()->ToElement();
}

std::optional<std::string_view> declared_namespace(const tinyxml2::XMLElement* element,
                                                   std::string_view wanted_prefix) {
  const std::string attribute =
      wanted_prefix.empty() ? "xmlns" : fmt::format("xmlns:{}", wanted_prefix);
  for (; element != nullptr; element = parent_element(element)) {
    if (const char* uri = element->Attribute(attribute.c_str())) return uri;
  }
  return std::nullopt;
}

std::string content_of(const std::filesystem::path& path, std::error_code& error) {
  std::string content;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (file != nullptr) {
    char piece[4096];
    while (const std::size_t count = std::fread(piece, 1, sizeof piece, file.get())) {
      content.append(piece, count);
    }
    if (std::ferror(file.get()) == 0) return content;
  }
  error.assign(errno, std::generic_category());
  return content;
}

/// The encoding that the XML declaration names, in small letters; UTF-8 if it names none.
std::string declared_encoding(const std::string& text) {
  const std::string_view head = std::string_view(text).substr(0, text.find("?>"));
  const std::size_t name = head.find("encoding");
  const std::size_t begin = name == head.npos ? head.npos : head.find_first_of("'\"", name);
  if (!starts_with(head, "<?xml") || begin == head.npos) return "utf-8";
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
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "more than 100 elements inside each other";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "the file holds nothing";
    default:
      return "text where a tag is expected";
  }
}

}  // namespace

XmlElement::XmlElement(const tinyxml2::XMLElement& element, const std::string& file)
    : element_(&element), file_(&file) {}

XmlName XmlElement::name() const {
  const std::string_view qualified = element_->Name();
  const auto uri = declared_namespace(element_, prefix(qualified));
  if (!uri && !prefix(qualified).empty()) {
    fail(fmt::format("the prefix '{}' of {} is not declared", prefix(qualified), tag()),
         fmt::format("declare it in the root element: xmlns:{}=\"…\"", prefix(qualified)));
  }
  return {uri.value_or(std::string_view{}), local(qualified)};
}

std::string XmlElement::tag() const { return fmt::format("<{}>", element_->Name()); }

core::Location XmlElement::where() const { return {*file_, element_->GetLineNum()}; }

std::optional<std::string> XmlElement::prefix_of(std::string_view name_space) const {
  for (auto element = element_; element != nullptr; element = parent_element(element)) {
    for (auto it = element->FirstAttribute(); it != nullptr; it = it->Next()) {
      const std::string_view attribute = it->Name();
      const bool declares = attribute == "xmlns" || starts_with(attribute, "xmlns:");
      if (!declares || it->Value() != name_space) continue;
      const std::string found(attribute == "xmlns" ? "" : local(attribute));
      if (declared_namespace(element_, found) == name_space) return found;
    }
  }
  return std::nullopt;
}

std::size_t XmlElement::index() const {
  std::size_t before = 0;
  const tinyxml2::XMLNode* node = element_;
  while (node != nullptr) {
    if (node->PreviousSibling() != nullptr) {
      node = node->PreviousSibling();
      while (node->LastChild() != nullptr) node = node->LastChild();
    } else {
      node = node->Parent();
    }
    if (node != nullptr && node->ToElement() != nullptr) ++before;
  }
  return before;
}

std::optional<std::string> XmlElement::attribute(const char* name) const {
  const char* value = element_->Attribute(name);
  if (value == nullptr) return std::nullopt;
  return value;
}

std::string XmlElement::required(const char* name) const {
  const auto value = attribute(name);
  if (!value) fail(fmt::format("{} needs the attribute '{}'", tag(), name));
  if (value->empty()) fail(fmt::format("the attribute '{}' of {} is empty", name, tag()));
  return *value;
}

bool XmlElement::flag(const char* name, bool otherwise) const {
  const auto value = attribute(name);
  if (!value) return otherwise;
  if (*value == "true" || *value == "1") return true;
  if (*value == "false" || *value == "0") return false;
  fail(fmt::format("{}=\"{}\" is neither true nor false", name, *value));
}

std::vector<XmlElement> XmlElement::children() const {
  std::vector<XmlElement> found;
  for (auto it = element_->FirstChildElement(); it != nullptr; it = it->NextSiblingElement()) {
    found.emplace_back(*it, *file_);
  }
  return found;
}

std::vector<XmlElement> XmlElement::children(XmlName name) const {
  std::vector<XmlElement> found = children();
  std::erase_if(found, [&](const XmlElement& element) { return element.name() != name; });
  return found;
}

std::optional<XmlElement> XmlElement::child(XmlName name) const {
  const std::vector<XmlElement> found = children(name);
  if (found.empty()) return std::nullopt;
  if (found.size() > 1) {
    found[1].fail(fmt::format("a second {} in {}; the first is in line {}", found[1].tag(), tag(),
                              found[0].where().line));
  }
  return found[0];
}

std::optional<XmlElement> XmlElement::parent() const {
  const tinyxml2::XMLElement* parent = parent_element(element_);
  if (parent == nullptr) return std::nullopt;
  return XmlElement(*parent, *file_);
}

void XmlElement::allow_attributes(std::initializer_list<std::string_view> names) const {
  for (auto it = element_->FirstAttribute(); it != nullptr; it = it->Next()) {
    const std::string attribute = it->Name();
    const bool is_foreign = attribute == "xmlns" || attribute.find(':') != std::string::npos;
    if (is_foreign || attribute == "id" || attribute == "description") continue;
    if (std::find(names.begin(), names.end(), attribute) != names.end()) continue;
    const std::vector<std::string> known(names.begin(), names.end());
    fail(fmt::format("{} has no attribute '{}'", tag(), attribute),
         core::suggestion(attribute, known));
  }
}

void XmlElement::allow_children(std::initializer_list<XmlName> names) const {
  for (const XmlElement& element : children()) {
    const XmlName found = element.name();
    if (std::find(names.begin(), names.end(), found) != names.end()) continue;
    std::vector<std::string> known;
    for (const XmlName& name : names) known.emplace_back(name.local);
    const std::string written(found.local);
    if (std::find(known.begin(), known.end(), written) != known.end()) {
      const auto name = *std::find_if(names.begin(), names.end(),
                                      [&](const XmlName& n) { return n.local == written; });
      element.fail(fmt::format("{} is in the namespace '{}'", element.tag(), found.name_space),
                   fmt::format("it belongs in '{}'", name.name_space));
    }
    element.fail(fmt::format("{} is not known in {}", element.tag(), tag()),
                 core::suggestion(written, known));
  }
}

void XmlElement::fail(const std::string& message, const std::string& hint) const {
  core::fail_input({.where = where()}, message, hint);
}

void XmlElement::fail_unsupported(const std::string& what, const std::string& hint) const {
  fail(fmt::format("this version of stride does not support {}", what), hint);
}

XmlDocument::XmlDocument(const std::filesystem::path& path)
    : file_(path.string()), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  read(path);
  parse();
}

XmlDocument::~XmlDocument() = default;

void XmlDocument::fail(const std::string& message, const std::string& hint) const {
  core::fail_input({.where = {file_, 0}}, message, hint);
}

void XmlDocument::read(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail("the file does not exist", "check its path");
  if (std::filesystem::is_directory(status)) {
    fail("this is a folder, expected a file", "name the file inside it");
  }
  text_ = content_of(path, error);
  if (error) {
    fail(fmt::format("cannot read the file: {}", error.message()),
         "check that it is a file that you may read");
  }
}

void XmlDocument::parse() {
  if (starts_with(text_, "PK\x03\x04")) {
    fail("this is a packed archive (such as .ssp or .fmu), expected an XML file",
         "unpack it, and name the SystemStructure.ssd inside it");
  }
  if (starts_with(text_, "\xff\xfe") || starts_with(text_, "\xfe\xff") ||
      text_.find('\0') != std::string::npos) {
    fail("this is no text in UTF-8", "save it as XML with the encoding UTF-8");
  }
  const std::string encoding = declared_encoding(text_);
  if (encoding != "utf-8" && encoding != "us-ascii") {
    fail(fmt::format("the encoding '{}' is not read", encoding),
         "save it as XML with the encoding UTF-8");
  }
  if (document_->Parse(text_.data(), text_.size()) != tinyxml2::XML_SUCCESS) {
    core::fail_input(
        {.where = {file_, document_->ErrorLineNum()}},
        fmt::format("this is not well-formed XML: {}", words_for(document_->ErrorID())),
        "look for a missing end tag or quotation mark in or above this line");
  }
  const tinyxml2::XMLElement* root = document_->RootElement();
  if (root == nullptr) fail("the file holds no XML element");
  if (const auto second = root->NextSiblingElement()) {
    XmlElement(*second, file_).fail(fmt::format("a second root element <{}>", second->Name()));
  }
}

XmlElement XmlDocument::root() const { return {*document_->RootElement(), file_}; }

}  // namespace stride::io
