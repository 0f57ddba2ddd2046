// Changes to an XML text that leave every other byte of it as it is.
#ifndef STRIDE_MASTER_BASE_XML_EDITOR_H
#define STRIDE_MASTER_BASE_XML_EDITOR_H

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace stride::xml {

/// The position of an element in the text, as offsets.
struct ElementPlace {
  std::size_t begin = 0;          ///< of the start tag
  std::size_t start_tag_end = 0;  ///< behind its '>'
  std::size_t end_tag = 0;        ///< where the end tag begins; of an empty-element tag: its end
  std::size_t end = 0;            ///< behind the element
  bool is_empty_tag = false;      ///< <a/>
};

/// The end of what begins at `at` and is no element: a comment, a CDATA section, a processing
/// instruction, a declaration. `at` itself if something else begins there.
std::size_t markup_end(std::string_view text, std::size_t at);

/// The start and end tags of a text, in order. A text that is not well-formed may end within one.
class TagScanner {
 public:
  explicit TagScanner(std::string_view text) : text_(text) {}

  /// Goes on to the next tag; returns whether there is one.
  bool next();
  std::size_t begin() const { return begin_; }
  std::size_t end() const { return end_; }        ///< behind its '>'
  std::size_t quoted() const { return quoted_; }  ///< how many texts in quotation marks are in it

 private:
  void find_end();

  std::string_view text_;
  std::size_t begin_ = 0, end_ = 0, quoted_ = 0;
};

/// The places of all elements in document order. The text must be well-formed.
std::vector<ElementPlace> element_places(const std::string& text);

/// Collects changes, then makes them all at once.
class Editor {
 public:
  /// The text must be well-formed and outlive the editor.
  explicit Editor(const std::string& text);

  /// The blanks before an element that begins its line, else nothing.
  std::string indentation(std::size_t element) const;
  /// Each piece is an element, which may span lines; a tab in it is one step of indentation. It
  /// gets a line of its own, indented by one step below its new parent; `element` is a place in
  /// document order (Element::index).
  void prepend_children(std::size_t element, const std::vector<std::string>& pieces);
  void append_children(std::size_t element, const std::vector<std::string>& pieces);
  void insert_behind(std::size_t element, const std::string& piece);
  void add_attribute(std::size_t element, const std::string& name, const std::string& value);
  /// Replaces the value of an attribute, which the element must have.
  void set_attribute(std::size_t element, const std::string& name, const std::string& value);

  std::string result() const;

 private:
  struct Edit {
    std::size_t at;
    std::size_t erased;
    std::string inserted;
  };
  std::string lines(const std::vector<std::string>& pieces, const std::string& indentation) const;
  void open_empty_tag(std::size_t element, const std::vector<std::string>& pieces);

  const std::string& text_;
  std::vector<ElementPlace> places_;
  std::string line_end_;
  std::string step_;
  std::vector<Edit> edits_;
};

}  // namespace stride::xml

#endif
