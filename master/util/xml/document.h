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
  /// names file and line for what is missing, no regular file, not readable, too large, in an
  /// encoding that is not known or not well-formed.
  explicit Document(const std::filesystem::path& path, const std::string& shown_as = "");
  /// The same from what the file holds.
  static Document parse(std::string bytes, const std::string& shown_as);
  ~Document();
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;

  /// In UTF-8, whatever the encoding of the file; its lines and elements are those of the file.
  const std::string& text() const;
  /// Of bytes that are no characters in the encoding that the file declares; empty if there are
  /// none.
  const std::string& warning() const;
  /// Valid as long as the document, also when that is moved.
  Element root() const;

 private:
  struct Content;
  explicit Document(std::unique_ptr<Content> content);

  std::unique_ptr<Content> content_;
};

}  // namespace stride::xml

#endif
