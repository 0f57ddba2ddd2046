// XML elements whose errors contain their place and what was expected.
#ifndef STRIDE_UNITS_XML_ELEMENT_H
#define STRIDE_UNITS_XML_ELEMENT_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

namespace tinyxml2 {
class XMLElement;
}

namespace xml {

/// An element of a file. All its functions throw std::runtime_error with the file and the line.
/// It refers to the document and the file's name, which have to outlive it.
class Element {
 public:
  Element(const tinyxml2::XMLElement& element, const std::string& file)
      : element_(&element), file_(&file) {}

  std::string name() const;
  std::vector<Element> children() const;

  /// The value of an attribute; without a fallback it has to be there.
  std::string text(const char* attribute) const;
  double number(const char* attribute) const;
  double number(const char* attribute, double fallback) const;
  stride::Time time(const char* attribute) const;  ///< from seconds, 0 or later

  /// The same with bounds, both included.
  double number_within(const char* attribute, double least, double most) const;
  /// Decimal, or hexadecimal after 0x.
  std::uint64_t whole_number(const char* attribute, std::uint64_t least, std::uint64_t most) const;

  bool has(const char* attribute) const { return find(attribute).has_value(); }

  /// Rejects any attribute that is not in the list, and any text between the children.
  void allow_only(const std::vector<std::string>& attributes) const;
  /// The same, and no children either.
  void allow_only_leaf(const std::vector<std::string>& attributes) const;

  /// Throws "file:line: <name>: message".
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::optional<std::string> find(const char* attribute) const;
  double to_number(const char* attribute, const std::string& value) const;

  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

}  // namespace xml

#endif
