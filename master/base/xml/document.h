// An XML document in memory.
#ifndef STRIDE_MASTER_BASE_XML_DOCUMENT_H
#define STRIDE_MASTER_BASE_XML_DOCUMENT_H

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/base/xml/element.h"

namespace stride::xml {

/// A prefix, and the namespace that it usually is for.
struct Prefix {
  const char* name;
  const char* name_space;
};

class Document {
 public:
  /// Reads a file; complaints call it `shown_as`, or by its path. Throws core::Error (Input) that
  /// names file and line for what is missing, no regular file, not readable, too large, in an
  /// encoding that is not known or not well-formed.
  explicit Document(const std::filesystem::path& path, const std::string& shown_as = "",
                    std::span<const Prefix> known = {});
  /// The same from what the file holds. Prefixes that are `known` may be used without a
  /// declaration, and their namespaces be written with https, or with a '/' at the end.
  static Document parse(std::string bytes, const std::string& shown_as,
                        std::span<const Prefix> known = {});
  ~Document();
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;

  /// In UTF-8, whatever the encoding of the file; its lines and elements are those of the file.
  const std::string& text() const;
  /// Of bytes that are no characters in the encoding that the file declares, of prefixes that it
  /// does not declare, and of namespaces that are written in another way.
  const std::vector<std::string>& warnings() const;
  /// Valid as long as the document, also when that is moved.
  Element root() const;

 private:
  struct Content;
  static void respell(const Prefix& prefix, tinyxml2::XMLElement& below, Content& content);
  static void declare(const Prefix& prefix, tinyxml2::XMLElement& root, Content& content);
  explicit Document(std::unique_ptr<Content> content);

  std::unique_ptr<Content> content_;
};

}  // namespace stride::xml

#endif
