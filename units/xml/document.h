// A file of a unit's own, in XML.
#ifndef STRIDE_UNITS_XML_DOCUMENT_H
#define STRIDE_UNITS_XML_DOCUMENT_H

#include <memory>
#include <string>

#include "units/xml/element.h"

namespace tinyxml2 {
class XMLDocument;
}

namespace xml {

/// Its root element has the attribute version="1" and no other. All functions throw
/// std::runtime_error with the file, the line and what was expected.
class Document {
 public:
  static Document load(const std::string& path, const std::string& root);
  /// From a text, for whose errors `name` is the file.
  static Document parse(const std::string& text, const std::string& name, const std::string& root);

  Document(Document&& other) noexcept;
  Document& operator=(Document&&) = delete;
  ~Document();

  /// Refers to this object, as do its children.
  Element root() const;

 private:
  Document(std::unique_ptr<tinyxml2::XMLDocument> document, const std::string& name,
           const std::string& root);

  std::unique_ptr<tinyxml2::XMLDocument> document_;
  std::unique_ptr<const std::string> name_;
};

}  // namespace xml

#endif
