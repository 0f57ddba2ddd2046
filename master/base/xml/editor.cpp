#include "master/base/xml/editor.h"

#include <algorithm>
#include <string_view>

#include <stride/xml_text.h>

namespace stride::xml {
namespace {

constexpr const char* kBlanks = " \t\r\n";

}  // namespace

std::size_t markup_end(std::string_view text, std::size_t at) {
  struct Kind {
    std::string_view begin, end;
  };
  constexpr Kind kKinds[] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}, {"<!", ">"}};
  for (const Kind& kind : kKinds) {
    if (!text.substr(at).starts_with(kind.begin)) continue;
    const std::size_t end = text.find(kind.end, at + kind.begin.size());
    return end == std::string::npos ? text.size() : end + kind.end.size();
  }
  return at;
}

bool TagScanner::next() {
  while ((begin_ = text_.find('<', end_)) != text_.npos) {
    end_ = markup_end(text_, begin_);
    if (end_ != begin_) continue;
    find_end();
    return true;
  }
  return false;
}

void TagScanner::find_end() {
  char quote = 0;
  quoted_ = 0;
  while (end_ < text_.size()) {
    const char c = text_[end_++];
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
      ++quoted_;
    } else if (c == '>') {
      return;
    }
  }
}

std::vector<ElementPlace> element_places(const std::string& text) {
  std::vector<ElementPlace> places;
  std::vector<std::size_t> open;
  TagScanner tags(text);
  while (tags.next()) {
    const std::size_t at = tags.begin(), end = tags.end();
    if (text.compare(at, 2, "</") == 0) {
      if (open.empty()) break;
      places[open.back()].end_tag = at;
      places[open.back()].end = end;
      open.pop_back();
    } else {
      const bool is_empty = end >= 2 && text[end - 2] == '/';
      if (!is_empty) open.push_back(places.size());
      places.push_back({at, end, end, end, is_empty});
    }
  }
  return places;
}

Editor::Editor(const std::string& text)
    : text_(text),
      places_(element_places(text)),
      line_end_(text.find("\r\n") == std::string::npos ? "\n" : "\r\n"),
      step_("  ") {
  if (places_.size() < 2) return;
  const std::string outer = indentation(0);
  const std::string inner = indentation(1);
  if (inner.size() > outer.size()) step_ = inner.substr(outer.size());
}

std::string Editor::indentation(std::size_t element) const {
  const std::string_view before = std::string_view(text_).substr(0, places_[element].begin);
  const std::size_t first = before.find_last_not_of(" \t") + 1;  // 0 if there is nothing else
  const bool begins_line = first == 0 || before[first - 1] == '\n';
  return begins_line ? std::string(before.substr(first)) : "";
}

std::string Editor::lines(const std::vector<std::string>& pieces,
                          const std::string& indentation) const {
  std::string joined;
  for (const std::string& piece : pieces) {
    joined += line_end_ + indentation;
    for (const char c : piece) {
      if (c == '\n') {
        joined += line_end_ + indentation;
      } else if (c == '\t') {
        joined += step_;
      } else {
        joined += c;
      }
    }
  }
  return joined;
}

void Editor::open_empty_tag(std::size_t element, const std::vector<std::string>& pieces) {
  const ElementPlace& place = places_[element];
  const std::size_t last = text_.find_last_not_of(kBlanks, place.end - 3);
  const std::size_t name_end = text_.find_first_of(" \t\r\n/>", place.begin);
  const std::string name = text_.substr(place.begin + 1, name_end - place.begin - 1);
  const std::string outer = indentation(element);
  edits_.push_back({last + 1, place.end - last - 1,
                    ">" + lines(pieces, outer + step_) + line_end_ + outer + "</" + name + ">"});
}

void Editor::prepend_children(std::size_t element, const std::vector<std::string>& pieces) {
  if (pieces.empty()) return;
  const ElementPlace& place = places_[element];
  if (place.is_empty_tag) return open_empty_tag(element, pieces);
  const std::string outer = indentation(element);
  std::string inserted = lines(pieces, outer + step_);
  const char next = text_[place.start_tag_end];
  if (next != '\n' && next != '\r') {
    inserted += line_end_ + outer + (place.end_tag == place.start_tag_end ? "" : step_);
  }
  edits_.push_back({place.start_tag_end, 0, inserted});
}

void Editor::append_children(std::size_t element, const std::vector<std::string>& pieces) {
  if (pieces.empty()) return;
  const ElementPlace& place = places_[element];
  if (place.is_empty_tag) return open_empty_tag(element, pieces);
  const std::string outer = indentation(element);
  const std::size_t at = text_.find_last_not_of(kBlanks, place.end_tag - 1) + 1;
  std::string inserted = lines(pieces, outer + step_);
  if (std::string_view(text_).substr(at, place.end_tag - at).find('\n') == std::string_view::npos) {
    inserted += line_end_ + outer;
  }
  edits_.push_back({at, 0, inserted});
}

void Editor::insert_behind(std::size_t element, const std::string& piece) {
  edits_.push_back({places_[element].end, 0, lines({piece}, indentation(element))});
}

void Editor::add_attribute(std::size_t element, const std::string& name, const std::string& value) {
  const ElementPlace& place = places_[element];
  const std::size_t close = place.start_tag_end - (place.is_empty_tag ? 2 : 1);
  const std::size_t at = text_.find_last_not_of(kBlanks, close - 1) + 1;
  edits_.push_back({at, 0, " " + name + "=\"" + xml_escaped(value) + "\""});
}

void Editor::set_attribute(std::size_t element, const std::string& name, const std::string& value) {
  const ElementPlace& place = places_[element];
  std::size_t at = text_.find_first_of(kBlanks, place.begin);
  while (at < place.start_tag_end) {
    const std::size_t begin = text_.find_first_not_of(kBlanks, at);
    const std::size_t equals = text_.find('=', begin);
    const std::size_t open = text_.find_first_of("'\"", equals);
    if (open >= place.start_tag_end) break;
    const std::size_t close = text_.find(text_[open], open + 1);
    const std::size_t name_end = text_.find_last_not_of(kBlanks, equals - 1) + 1;
    if (text_.substr(begin, name_end - begin) == name) {
      edits_.push_back({open, close + 1 - open, "\"" + xml_escaped(value) + "\""});
      return;
    }
    at = close + 1;
  }
}

std::string Editor::result() const {
  std::vector<Edit> edits = edits_;
  std::stable_sort(edits.begin(), edits.end(),
                   [](const Edit& a, const Edit& b) { return a.at < b.at; });
  std::string result;
  std::size_t at = 0;
  for (const Edit& edit : edits) {
    result.append(text_, at, edit.at - at).append(edit.inserted);
    at = edit.at + edit.erased;
  }
  return result + text_.substr(at);
}

}  // namespace stride::xml
