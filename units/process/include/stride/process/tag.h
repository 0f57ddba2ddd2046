// The lines that stride and a program write to each other: a tag each, as docs/process-protocol.md
// has it. For both sides, and for programs without <stride/process/program.h>.
#ifndef STRIDE_PROCESS_TAG_H
#define STRIDE_PROCESS_TAG_H

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <stride/process/value.h>
#include <stride/xml_text.h>

namespace stride::process {

/// An XML empty-element tag that is alone on its line: <name attribute="value" …/>. Names are
/// of ASCII letters, digits and _ - . :, values are in UTF-8, quoted with " or ', with the
/// references of XML (&lt; &#10; &#x20AC; …).
class Tag {
 public:
  /// Reads a line, with or without its line feed. The line has to stay where it is as long as the
  /// tag is read from; so do the references that the other functions return, until the next parse.
  /// Throws std::invalid_argument "column N: expected …" and leaves no usable tag.
  void parse(std::string_view line);

  std::string_view name() const { return name_; }
  bool has(std::string_view attribute) const { return find(attribute) != nullptr; }
  /// The value of an attribute. Throws std::invalid_argument if it is missing.
  std::string_view text(std::string_view attribute) const;
  /// The same as a value of the type T; see <stride/process/value.h>.
  template <class T>
  T value(std::string_view attribute) const {
    T value{};
    parse_value(text(attribute), value);
    return value;
  }
  /// Throws std::invalid_argument if there is any other attribute than these.
  void allow_only(std::initializer_list<std::string_view> attributes) const;

  std::size_t size() const { return size_; }
  std::string_view attribute_name(std::size_t i) const { return attributes_[i].name; }
  std::string_view attribute_value(std::size_t i) const { return attributes_[i].value(); }

 private:
  struct Attribute {
    std::string_view name;
    std::string_view raw;
    std::string decoded;  ///< where the raw text has references
    bool has_references = false;
    std::string_view value() const { return has_references ? std::string_view(decoded) : raw; }
  };

  const Attribute* find(std::string_view attribute) const;
  [[noreturn]] void fail(const std::string& expected) const;
  bool at_end() const { return at_ == line_.size(); }
  bool is_at(char c) const { return !at_end() && line_[at_] == c; }
  bool skip_blanks();
  void expect(char c);
  std::string_view take_name();
  void take_attribute();
  void take_value(Attribute& attribute);
  void decode(Attribute& attribute);
  std::uint32_t take_reference(std::string_view reference) const;

  std::string_view line_;
  std::size_t at_ = 0;
  std::string_view name_;
  std::vector<Attribute> attributes_;  ///< of which `size_` count: their memory is used again
  std::size_t size_ = 0;
};

/// Appends a tag and a line feed to a text.
///
///   TagWriter(text, "output").value("name", name).value("value", 0.5).end();
class TagWriter {
 public:
  TagWriter(std::string& text, std::string_view name) : text_(text) {
    text_.append("<").append(name);
  }

  /// Of any type in <stride/process/value.h>. Throws std::invalid_argument for a text that XML
  /// cannot hold.
  template <class T>
  TagWriter& value(std::string_view attribute, const T& value) {
    text_.append(" ").append(attribute).append("=\"");
    if constexpr (std::is_convertible_v<const T&, std::string_view>) {
      escape(value);
    } else {
      append_value(text_, value);
    }
    text_ += '"';
    return *this;
  }
  void end() { text_ += "/>\n"; }

 private:
  void escape(std::string_view value);

  std::string& text_;
};

// ---- Reading ----

inline void Tag::parse(std::string_view line) {
  line_ = line;
  at_ = size_ = 0;
  name_ = {};
  skip_blanks();
  expect('<');
  name_ = take_name();
  while (true) {
    const bool blanks = skip_blanks();
    if (is_at('/')) break;
    if (!blanks) fail("a blank or '/>'");
    take_attribute();
  }
  ++at_;
  expect('>');
  skip_blanks();
  if (!at_end()) fail("the end of the line behind the tag");
}

inline std::string_view Tag::text(std::string_view attribute) const {
  if (const Attribute* found = find(attribute)) return found->value();
  throw std::invalid_argument("expected the attribute '" + std::string(attribute) + "'");
}

inline void Tag::allow_only(std::initializer_list<std::string_view> attributes) const {
  for (std::size_t i = 0; i < size_; ++i) {
    bool is_known = false;
    for (const std::string_view known : attributes) is_known |= attribute_name(i) == known;
    if (is_known) continue;
    std::string list;
    for (const std::string_view known : attributes) {
      list.append(list.empty() ? "" : ", ").append(known);
    }
    throw std::invalid_argument("unknown attribute '" + std::string(attribute_name(i)) +
                                "'; expected " + (list.empty() ? "none" : list));
  }
}

inline const Tag::Attribute* Tag::find(std::string_view attribute) const {
  for (std::size_t i = 0; i < size_; ++i) {
    if (attributes_[i].name == attribute) return &attributes_[i];
  }
  return nullptr;
}

inline void Tag::fail(const std::string& expected) const {
  throw std::invalid_argument("column " + std::to_string(at_ + 1) + ": expected " + expected);
}

inline bool Tag::skip_blanks() {
  const std::size_t before = at_;
  while (is_at(' ') || is_at('\t') || is_at('\r') || is_at('\n')) ++at_;
  return at_ != before;
}

inline void Tag::expect(char c) {
  if (!is_at(c)) fail(std::string("'") + c + "'");
  ++at_;
}

inline std::string_view Tag::take_name() {
  const auto is_letter = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  const auto is_name = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == ':';
  };
  const std::size_t first = at_;
  if (at_end() || !is_letter(line_[at_])) fail("a name");
  while (!at_end() && is_name(line_[at_])) ++at_;
  return line_.substr(first, at_ - first);
}

inline void Tag::take_attribute() {
  const std::string_view name = take_name();
  if (has(name)) fail("no second attribute '" + std::string(name) + "'");
  skip_blanks();
  expect('=');
  skip_blanks();
  if (attributes_.size() == size_) attributes_.emplace_back();
  Attribute& attribute = attributes_[size_];
  attribute.name = name;
  take_value(attribute);
  ++size_;
}

inline void Tag::take_value(Attribute& attribute) {
  if (!is_at('"') && !is_at('\'')) fail("a value in quotation marks");
  const char quote = line_[at_++];
  const std::size_t end = line_.find(quote, at_);
  if (end == std::string_view::npos) fail("a closing quotation mark");
  attribute.raw = line_.substr(at_, end - at_);
  const std::size_t bracket = attribute.raw.find('<');
  if (bracket != std::string_view::npos) {
    at_ += bracket;
    fail("&lt; in the place of < in a value");
  }
  if (const std::size_t bad = first_unfit(attribute.raw); bad != std::string_view::npos) {
    at_ += bad;
    fail("a character of XML in UTF-8");
  }
  attribute.has_references = attribute.raw.find('&') != std::string_view::npos;
  if (attribute.has_references) decode(attribute);
  at_ = end + 1;
}

inline void Tag::decode(Attribute& attribute) {
  const std::string_view raw = attribute.raw;
  const std::size_t begin = at_;
  attribute.decoded.clear();
  for (std::size_t i = 0; i < raw.size();) {
    const std::size_t mark = raw.find('&', i);
    attribute.decoded.append(raw.substr(i, mark - i));
    if (mark == std::string_view::npos) return;
    const std::size_t end = raw.find(';', mark);
    at_ = begin + mark;
    if (end == std::string_view::npos) fail("&amp; in the place of & in a value, or a reference");
    append_utf8(attribute.decoded, take_reference(raw.substr(mark + 1, end - mark - 1)));
    i = end + 1;
  }
}

inline std::uint32_t Tag::take_reference(std::string_view reference) const {
  if (reference == "lt") return '<';
  if (reference == "gt") return '>';
  if (reference == "amp") return '&';
  if (reference == "quot") return '"';
  if (reference == "apos") return '\'';
  const bool is_hexadecimal = reference.substr(0, 2) == "#x";
  const std::string_view digits = reference.substr(is_hexadecimal ? 2 : reference.empty() ? 0 : 1);
  std::uint32_t code = 0;
  const char* const last = digits.data() + digits.size();
  const auto [end, mistake] = std::from_chars(digits.data(), last, code, is_hexadecimal ? 16 : 10);
  const bool is_number = mistake == std::errc() && end == last && reference.front() == '#';
  if (is_number && is_xml_character(code)) return code;
  fail("a reference such as &lt; &amp; &quot; or &#10;");
}

// ---- Writing ----

inline void TagWriter::escape(std::string_view value) {
  if (first_unfit(value) != std::string_view::npos) {
    throw std::invalid_argument(
        "this text cannot be written in XML: it is not in UTF-8, or has control characters; a "
        "Binary "
        "can hold it");
  }
  for (const char c : value) {
    if (c == '>') {
      text_ += c;  // no markup within a value
    } else {
      append_xml_character(text_, c);
    }
  }
}

}  // namespace stride::process

#endif
