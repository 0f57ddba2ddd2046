// A read-only view of an XML document, whose complaints name file and line.
#ifndef STRIDE_MASTER_FMI_XML_H
#define STRIDE_MASTER_FMI_XML_H

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <tinyxml2.h>

#include "master/core/error.h"

namespace stride::fmi {

/// The words of a list attribute (xs:list).
std::vector<std::string_view> split(std::string_view list);

/// The whole word as a number (xs:int and its kin, xs:float, xs:double).
template <class T>
std::optional<T> to_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// Valid as long as its document.
class Element {
 public:
  Element(const tinyxml2::XMLElement& element, const std::string& file)
      : element_(&element), file_(&file) {}

  std::string name() const { return element_->Name(); }
  /// Whether it is this element, whatever the prefix by which it knows the namespace.
  bool is(std::string_view name_space, std::string_view local_name) const;
  core::Location where() const { return {*file_, element_->GetLineNum()}; }
  /// Throws core::Error of the kind Input with this element's place.
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;

  std::optional<Element> child(const char* name) const;
  /// The children of this name, or all of them, in order.
  std::vector<Element> children(const char* name = nullptr) const;

  std::optional<std::string> text(const char* attribute) const;
  /// An attribute of a namespace, whatever the prefix by which it is known.
  std::optional<std::string> text(std::string_view name_space, std::string_view local_name) const;
  std::string text_or(const char* attribute, const std::string& otherwise = "") const;
  std::string required_text(const char* attribute) const;
  bool flag(const char* attribute, bool otherwise = false) const;

  template <class T>
  std::optional<T> number(const char* attribute) const {
    const auto value = text(attribute);
    return value ? std::optional(checked<T>(attribute, *value)) : std::nullopt;
  }
  template <class T>
  T required_number(const char* attribute) const {
    return checked<T>(attribute, required_text(attribute));
  }
  template <class T>
  std::vector<T> number_list(const char* attribute) const {
    const std::string list = text_or(attribute);
    std::vector<T> values;
    for (const std::string_view word : split(list)) values.push_back(checked<T>(attribute, word));
    return values;
  }

 private:
  /// The namespace that a prefix means here, or the default one for an empty prefix.
  std::string_view name_space_of(std::string_view prefix) const;
  template <class T>
  T checked(const char* attribute, std::string_view word) const {
    const auto words = split(word);
    const auto value = words.size() == 1 ? to_number<T>(words.front()) : std::nullopt;
    if (!value) fail_number(attribute, word, std::is_integral_v<T>);
    return *value;
  }
  [[noreturn]] void fail_number(const char* attribute, std::string_view value,
                                bool is_integer) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

/// A document in memory.
class Document {
 public:
  /// Throws core::Error of the kind Input, at the file's name and the line, for what is not
  /// well-formed or has no element.
  Document(const std::string& text, std::string shown_as);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Element root() const { return {*document_.RootElement(), shown_as_}; }

 private:
  tinyxml2::XMLDocument document_;
  std::string shown_as_;
};

/// The text of a file; throws core::Error of the kind Input if it cannot be read. `what` it is and
/// what it is `shown_as` are for the message.
std::string read_text(const std::filesystem::path& file, const std::string& what,
                      const std::string& shown_as);

}  // namespace stride::fmi

#endif
