// An XML document in memory.
#ifndef STRIDE_MASTER_UTIL_XML_DOCUMENT_H
#define STRIDE_MASTER_UTIL_XML_DOCUMENT_H

#include <filesystem>
#include <memory>
#include <string>

#include "master/util/xml/element.h"

namespace stride::xml {

class Document {
 public:
  /// Reads a file; complaints call it `shown_as`, or by its path. Throws core::Error (Input) that
  /// names file and line for what is missing, no regular file, not readable, too large, not in
  /// UTF-8 or not well-formed.
  explicit Document(const std::filesystem::path& path, const std::string& shown_as = "");
  /// The same from the document's text.
  static Document parse(std::string text, const std::string& shown_as);
  ~Document();
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;

  const std::string& text() const;
  /// Valid as long as the document, also when that is moved.
  Element root() const;

 private:
  struct Content;
  explicit Document(std::unique_ptr<Content> content);

  std::unique_ptr<Content> content_;
};

}  // namespace stride::xml

#endif
