#include "master/observe/trace/reader.h"

#include <charconv>
#include <utility>

#include <fmt/format.h>

namespace stride::trace {
namespace {

bool opens_changes(std::string_view keyword) {
  return keyword == "$dumpvars" || keyword == "$dumpall" || keyword == "$dumpon" ||
         keyword == "$dumpoff";
}

enum class WordKind { Stamp, Scalar, Vector, Section, Unknown };

/// By the first character.
inline WordKind kind_of(char first) {
  switch (first) {
    case '#':
      return WordKind::Stamp;
    case '0':
    case '1':
    case 'x':
    case 'X':
    case 'z':
    case 'Z':
    case 'u':
    case 'U':
    case 'w':
    case 'W':
    case 'l':
    case 'L':
    case 'h':
    case 'H':
    case '-':
    case '?':  // SystemC's, for a value that it has no letter for
      return WordKind::Scalar;
    case 'b':
    case 'B':
    case 'r':
    case 'R':
    case 's':
    case 'S':
      return WordKind::Vector;
    case '$':
      return WordKind::Section;
    default:
      return WordKind::Unknown;
  }
}

}  // namespace

Reader::Reader(std::filesystem::path file, CutOff cut_off)
    : words_(std::move(file)), header_(read_header(words_)), on_cut_(cut_off) {}

const Entry* Reader::next() {
  if (cut_) return nullptr;
  const std::string_view word = words_.next();
  if (word.empty()) return end_of_file();
  entry_.line = words_.line();
  if (words_.is_at_end() && word != "$end") {
    return cut_off(fmt::format("'{}' (no line end follows)", Words::shown(word)),
                   "; a file that is whole needs a last line end");
  }
  switch (kind_of(word.front())) {
    case WordKind::Stamp:
      return read_stamp(word);
    case WordKind::Scalar:
      return read_scalar(word);
    case WordKind::Vector:
      return read_vector(word);
    case WordKind::Section:
      return read_section(word);
    case WordKind::Unknown:
      break;
  }
  fail(entry_.line,
       fmt::format("'{}' is not a time stamp, no change and no section", Words::shown(word)),
       "expected #TIME, a change such as 1! or b101 !, or a section such as $comment; extended "
       "dumps ($dumpports) are not supported");
}

const Entry* Reader::read_stamp(std::string_view word) {
  const char* const end = word.data() + word.size();
  const auto read = std::from_chars(word.data() + 1, end, entry_.stamp);
  if (read.ec == std::errc::result_out_of_range) {
    fail(entry_.line, fmt::format("the time stamp {} is beyond 2^63 - 1", Words::shown(word)));
  }
  if (read.ec != std::errc{} || read.ptr != end || word[1] == '-') {
    fail(entry_.line,
         fmt::format("'{}' is not a time stamp; expected # and a whole number, such as "
                     "#1000",
                     Words::shown(word)));
  }
  if (last_stamp_ && entry_.stamp < *last_stamp_) {
    fail(entry_.line,
         fmt::format("time goes back to #{} from #{} in line {}", entry_.stamp, *last_stamp_,
                     last_stamp_line_),
         "two traces in one file have to be taken apart");
  }
  last_stamp_ = entry_.stamp;
  last_stamp_line_ = entry_.line;
  open_section_.clear();
  entry_.kind = Entry::Kind::Stamp;
  return &entry_;
}

const Entry* Reader::change(std::string_view value, std::string_view code) {
  const auto number = header_.codes.find(code);
  if (!number) {
    fail(entry_.line, fmt::format("no variable has the identifier code '{}'", Words::shown(code)),
         "the header declares all of them; is a part of the file lost?");
  }
  entry_.kind = Entry::Kind::Change;
  entry_.code = *number;
  entry_.value = value;
  entry_.code_text = code;
  return &entry_;
}

const Entry* Reader::read_scalar(std::string_view word) {
  if (word.size() == 1) {
    fail(entry_.line, fmt::format("the value '{}' has no identifier code behind it", word));
  }
  return change(word.substr(0, 1), word.substr(1));
}

const Entry* Reader::read_vector(std::string_view word) {
  value_ = word;
  const std::string_view code = words_.next();
  if (code.empty() || words_.is_at_end()) {
    return cut_off(fmt::format("the change '{}'", Words::shown(value_)));
  }
  return change(value_, code);
}

const Entry* Reader::read_section(std::string_view word) {
  section_ = word;
  entry_.section = section_;
  if (section_ == "$end") {
    entry_.kind = Entry::Kind::DumpEnd;
    open_section_.clear();
    return &entry_;
  }
  if (opens_changes(section_)) {
    entry_.kind = Entry::Kind::Dump;
    open_section_ = section_;
    return &entry_;
  }
  entry_.kind = Entry::Kind::Section;
  std::string text;
  words_.record_into(&text);
  while (true) {
    const std::string_view inner = words_.next();
    if (inner == "$end") break;
    if (inner.empty()) {
      words_.record_into(nullptr);
      return cut_off(fmt::format("the {} of line {}", section_, entry_.line));
    }
    if (text.size() > Words::kLongest) {
      fail(entry_.line, fmt::format("the {} has no $end", Words::shown(section_)));
    }
  }
  words_.record_into(nullptr);
  section_ += text;
  entry_.section = section_;
  return &entry_;
}

const Entry* Reader::end_of_file() {
  if (open_section_.empty()) return nullptr;
  return cut_off("the " + open_section_);
}

const Entry* Reader::cut_off(const std::string& within, const std::string& further_hint) {
  cut_ = words_.line();
  if (on_cut_ == CutOff::Accept) return nullptr;
  fail(*cut_, "the file is cut off: it ends within " + within,
       "where a run crashed, --cut-off takes all instants but the last" + further_hint);
}

}  // namespace stride::trace
