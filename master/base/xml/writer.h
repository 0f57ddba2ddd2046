// A new XML document, written from its beginning to its end.
#ifndef STRIDE_MASTER_BASE_XML_WRITER_H
#define STRIDE_MASTER_BASE_XML_WRITER_H

#include <memory>
#include <string>

namespace tinyxml2 {
class XMLPrinter;
}

namespace stride::xml {

/// Texts are UTF-8. What is not, and characters that XML 1.0 cannot hold, such as most control
/// characters, become U+FFFD.
class Writer {
 public:
  Writer();
  ~Writer();

  /// Begins an element within the one that is open; the attributes follow, then what it holds. The
  /// name must outlive the element.
  void open(const char* name);
  void attribute(const char* name, const std::string& value);
  void text(const std::string& text);
  /// Ends the element that was opened last.
  void close();
  /// The document, whose elements are all closed.
  std::string document() const;

 private:
  std::unique_ptr<tinyxml2::XMLPrinter> printer_;
};

}  // namespace stride::xml

#endif
