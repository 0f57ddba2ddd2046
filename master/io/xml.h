// XML files as the readers need them: namespaces resolved, each element knows its line.
#ifndef STRIDE_MASTER_IO_XML_H
#define STRIDE_MASTER_IO_XML_H

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "master/core/error.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace stride::io {

/// The namespaces are the same for SSP 1.0 and 2.0.
inline constexpr const char* kSsd = "http://ssp-standard.org/SSP1/SystemStructureDescription";
inline constexpr const char* kSsc = "http://ssp-standard.org/SSP1/SystemStructureCommon";
inline constexpr const char* kSsv = "http://ssp-standard.org/SSP1/SystemStructureParameterValues";
inline constexpr const char* kSsm = "http://ssp-standard.org/SSP1/SystemStructureParameterMapping";
inline constexpr const char* kSsb = "http://ssp-standard.org/SSP1/SystemStructureSignalDictionary";
inline constexpr const char* kStrideScenario = "urn:org.stride:scenario:1";

/// An element's name: {kSsd, "Component"}.
struct XmlName {
  std::string_view name_space;
  std::string_view local;
  bool operator==(const XmlName&) const = default;
};

/// A view of an element; the document must outlive it.
class XmlElement {
 public:
  XmlElement(const tinyxml2::XMLElement& element, const std::string& file);

  XmlName name() const;
  bool is(std::string_view name_space, std::string_view local) const {
    return name() == XmlName{name_space, local};
  }
  /// As it is written: "<ssd:Component>".
  std::string tag() const;
  core::Location where() const;
  /// The prefix by which this namespace is known here, the empty text if it is the default one.
  std::optional<std::string> prefix_of(std::string_view name_space) const;
  /// Its place among all elements of the document, in document order; the root is 0.
  std::size_t index() const;

  std::optional<std::string> attribute(const char* name) const;
  /// An attribute that must be there and not be empty.
  std::string required(const char* name) const;
  bool flag(const char* name, bool otherwise) const;

  std::vector<XmlElement> children() const;
  std::vector<XmlElement> children(XmlName name) const;
  /// The only child of this name, if there is one; two are an error.
  std::optional<XmlElement> child(XmlName name) const;
  std::optional<XmlElement> parent() const;

  /// Refuses what is not listed, so that no misspelt word is passed over. Attributes of other
  /// namespaces, and the attributes `id` and `description`, are always allowed.
  void allow_attributes(std::initializer_list<std::string_view> names) const;
  void allow_children(std::initializer_list<XmlName> names) const;

  /// Throws core::Error (Input) with the element's file and line.
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;
  /// Says that this version cannot do it.
  [[noreturn]] void fail_unsupported(const std::string& what, const std::string& hint = "") const;

 private:
  const tinyxml2::XMLElement* element_;
  const std::string* file_;
};

class XmlDocument {
 public:
  /// Reads a file. Throws core::Error (Input) that names file and line for what is missing, not
  /// readable or not well-formed.
  explicit XmlDocument(const std::filesystem::path& path);
  ~XmlDocument();

  const std::string& text() const { return text_; }
  XmlElement root() const;

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const;
  void read(const std::filesystem::path& path);
  void parse();

  std::string file_;
  std::string text_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

}  // namespace stride::io

#endif
