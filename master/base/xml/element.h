// A read-only view of an XML document: namespaces are resolved, and each complaint names its file
// and line.
#ifndef STRIDE_MASTER_BASE_XML_ELEMENT_H
#define STRIDE_MASTER_BASE_XML_ELEMENT_H

#include <charconv>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include "master/base/error.h"
#include "master/base/text/number_text.h"

namespace tinyxml2 {
class XMLElement;
}

namespace stride::xml {

/// The words of a list (xs:list).
std::vector<std::string_view> split(std::string_view list);

/// What is between the blanks around a text, which count for nothing in most types of XML.
std::string without_blanks(std::string_view text);

/// The whole word as a number (xs:int and its kin, xs:float, xs:double).
template <class T>
std::optional<T> to_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>) {
    if (error == std::errc::result_out_of_range && core::is_tiny_number(word)) return T{0};
  }
  if (error != std::errc{}) return std::nullopt;
  return value;
}

/// An element's name. One text alone is a name in no namespace.
struct Name {
  constexpr Name(std::string_view in, std::string_view name) : name_space(in), local(name) {}
  constexpr Name(const char* name) : local(name) {}

  std::string_view name_space;
  std::string_view local;
  bool operator==(const Name&) const = default;
};

/// A view of an element; the document must outlive it. What is missing or malformed throws
/// core::Error (Input).
class Element {
 public:
  Element(const tinyxml2::XMLElement& element, const std::string& file);

  Name name() const;
  bool is(std::string_view name_space, std::string_view local) const {
    return name() == Name(name_space, local);
  }
  /// Without its prefix, which may be one that is not declared.
  std::string_view local_name() const;
  /// As it is written: "<ssd:Component>".
  std::string tag() const;
  core::Location where() const;
  /// The characters before its first child, without blanks around them.
  std::string text() const;
  /// The prefix by which this namespace is known here, the empty text if it is the default one.
  std::optional<std::string> prefix_of(std::string_view name_space) const;
  /// Its index among all elements of the document, in document order; the root is 0.
  std::size_t index() const;

  std::optional<std::string> attribute(const char* name) const;
  /// An attribute of a namespace, whatever the prefix by which it is known.
  std::optional<std::string> attribute(std::string_view name_space, std::string_view local) const;
  std::string attribute_or(const char* name, const std::string& otherwise = "") const;
  /// An attribute that must be there.
  std::string given(const char* name) const;
  /// An attribute that must be there and not be empty.
  std::string required(const char* name) const;
  /// Likewise, of one line: what names something in tables and messages.
  std::string required_line(const char* name) const;
  bool flag(const char* name, bool otherwise = false) const;
  /// Likewise, false where it is missing; True and FALSE, which some tools write, are taken with a
  /// warning.
  bool lenient_flag(const char* name, std::vector<std::string>& warnings) const;

  /// An attribute that is one of these words, nothing if it is missing; one in another case is
  /// taken for it with a warning.
  std::optional<std::string> lenient_word(const char* name, std::span<const std::string> words,
                                          std::vector<std::string>& warnings) const;

  template <class T>
  std::optional<T> number(const char* name) const {
    const auto value = attribute(name);
    return value ? std::optional(checked<T>(name, *value)) : std::nullopt;
  }
  template <class T>
  T required_number(const char* name) const {
    return checked<T>(name, given(name));
  }
  template <class T>
  std::vector<T> number_list(const char* name) const {
    const std::string list = attribute_or(name);
    std::vector<T> values;
    for (const std::string_view word : split(list)) values.push_back(checked<T>(name, word));
    return values;
  }

  std::vector<Element> children() const;
  std::vector<Element> children(Name name) const;
  /// The only child of this name, if there is one; two are an error.
  std::optional<Element> child(Name name) const;
  /// Likewise, in another case of letters with a warning if there is none in the right one.
  std::optional<Element> lenient_child(std::string_view name,
                                       std::vector<std::string>& warnings) const;
  std::optional<Element> parent() const;

  /// Refuses what is not listed, so that no misspelt word is ignored. Attributes of other
  /// namespaces, and the attributes `id` and `description`, are always allowed.
  void allow_attributes(std::span<const std::string_view> names) const;
  void allow_attributes(std::initializer_list<std::string_view> names) const {
    allow_attributes(std::span(names.begin(), names.size()));
  }
  void allow_children(std::initializer_list<Name> names) const {
    allow_children(std::span(names.begin(), names.size()));
  }
  void allow_children(std::span<const Name> names) const;

  /// Throws core::Error (Input) with the element's file and line.
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;
  /// Fails, since this version does not support it.
  [[noreturn]] void fail_unsupported(const std::string& what, const std::string& hint = "") const;

 private:
  template <class T>
  T checked(const char* attribute, std::string_view text) const {
    const auto words = split(text);
    const auto value = words.size() == 1 ? to_number<T>(words.front()) : std::nullopt;
    if (!value) fail_number(attribute, text, std::is_integral_v<T>);
    return *value;
  }
  [[noreturn]] void fail_number(const char* attribute, std::string_view value,
                                bool is_integer) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

}  // namespace stride::xml

#endif
