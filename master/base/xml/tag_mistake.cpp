#include "master/base/xml/tag_mistake.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "master/base/xml/editor.h"

namespace stride::xml {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";

/// A tag, which may be cut off.
struct Tag {
  std::string_view text;
  std::size_t begin;  ///< its position

  bool is_end() const { return text.starts_with("</"); }
  bool is_empty_element() const { return text.ends_with("/>"); }
  std::string_view name() const {
    const std::string_view rest = text.substr(is_end() ? 2 : 1);
    return rest.substr(0, rest.find_first_of(" \t\r\n/<>"));
  }
};

/// The position of the quotation mark that is open where this part of a tag ends.
std::optional<std::size_t> open_quote(std::string_view part) {
  std::optional<std::size_t> open;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (open) {
      if (part[i] == part[*open]) open.reset();
    } else if (part[i] == '"' || part[i] == '\'') {
      open = i;
    }
  }
  return open;
}

class TagChecker {
 public:
  explicit TagChecker(std::string_view text) : text_(text) {}

  std::optional<TagMistake> find() {
    for (TagScanner tags(text_); tags.next();) {
      const Tag tag{text_.substr(tags.begin(), tags.end() - tags.begin()), tags.begin()};
      if (auto mistake = check_end_of(tag)) return mistake;
      if (tag.is_end()) {
        if (open_.empty() || open_.back().name() != tag.name()) return wrong_end(tag);
        open_.pop_back();
      } else if (!tag.is_empty_element()) {
        open_.push_back(tag);
      }
    }
    if (open_.empty()) return std::nullopt;
    return missing_end();
  }

 private:
  /// XML allows '<' neither in a tag nor in the value of an attribute, so this one begins the next
  /// tag.
  std::optional<TagMistake> check_end_of(const Tag& tag) const {
    const std::size_t next = tag.text.find('<', 1);
    const std::string_view own = tag.text.substr(0, next);
    const auto quote = open_quote(own);
    if (next == std::string_view::npos) {
      if (own.ends_with('>') && !quote) return std::nullopt;
      return TagMistake{last_character(),
                        fmt::format("the file ends within the tag {}", beginning_of(tag)),
                        "it may have been cut off"};
    }
    if (quote) {
      return TagMistake{tag.begin + *quote,
                        fmt::format("a '<' in the value of an attribute of <{}>", tag.name()),
                        "a quotation mark may be missing behind the value; '<' itself is '&lt;'"};
    }
    return TagMistake{tag.begin, fmt::format("the tag {} has no '>'", beginning_of(tag)),
                      "write it before the next '<'"};
  }

  TagMistake wrong_end(const Tag& end) const {
    const std::string name(end.name());
    if (open_.empty()) {
      return {end.begin, fmt::format("</{}> ends no element, since all have ended", name),
              "leave it out, or write the start tag that belongs to it"};
    }
    const Tag& open = open_.back();
    const std::string started = fmt::format("<{}> of line {}", open.name(), line(open));
    const auto other = std::find_if(open_.rbegin(), open_.rend(),
                                    [&](const Tag& outer) { return outer.name() == end.name(); });
    if (other == open_.rend()) {
      return {end.begin, fmt::format("</{}> ends no element; the open one is {}", name, started),
              fmt::format("did you mean </{}>?", open.name())};
    }
    return {end.begin,
            fmt::format("</{}>, which ends the element of line {}, before the end tag of {}", name,
                        line(*other), started),
            fmt::format("write </{}> before it", open.name())};
  }

  TagMistake missing_end() const {
    const Tag& open = open_.back();
    return {
        last_character(),
        fmt::format("the file ends before the end tag of <{}> of line {}", open.name(), line(open)),
        open_.size() == 1
            ? fmt::format("write </{}> at its end", open.name())
            : fmt::format("it may have been cut off: {} elements have no end tag", open_.size())};
  }

  /// "<a", "</a"
  static std::string beginning_of(const Tag& tag) {
    return fmt::format("{}{}", tag.is_end() ? "</" : "<", tag.name());
  }
  int line(const Tag& tag) const { return line_at(text_, tag.begin); }
  std::size_t last_character() const {
    const std::size_t last = text_.find_last_not_of(kSpaces);
    return last == std::string_view::npos ? 0 : last;
  }

  std::string_view text_;
  std::vector<Tag> open_;  ///< start tags, the innermost last
};

}  // namespace

int line_at(std::string_view text, std::size_t position) {
  return 1 + static_cast<int>(std::ranges::count(text.substr(0, position), '\n'));
}

std::optional<TagMistake> find_tag_mistake(std::string_view text) {
  return TagChecker(text).find();
}

}  // namespace stride::xml
