#include "units/player/heading.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <stride/variable_name.h>

namespace player {
namespace {

constexpr const char* kTimeName = "time";

std::optional<Course> course_named(const std::string& word) {
  static const std::map<std::string, Course> kCourses = {
      {"linear", Course::Linear}, {"hold", Course::Hold}, {"event", Course::Event}};
  const auto found = kCourses.find(word);
  return found == kCourses.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Type> value_type_named(const std::string& word) {
  for (std::size_t i = 0; i < std::size(stride::kTypeNames); ++i) {
    const auto type = static_cast<Type>(i);
    const bool has_values = type != Type::Clock && type != Type::Enumeration;
    if (has_values && word == stride::kTypeNames[i]) return type;
  }
  return std::nullopt;
}

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

/// What other tools and languages call a type or a course.
std::string meant_word(const std::string& word) {
  static const std::map<std::string, const char*> kOthers = {
      {"int", "Int32"},         {"integer", "Int32"},   {"short", "Int16"},
      {"long", "Int64"},        {"uint", "UInt32"},     {"unsigned", "UInt32"},
      {"byte", "UInt8"},        {"float", "Float64"},   {"double", "Float64"},
      {"real", "Float64"},      {"number", "Float64"},  {"single", "Float32"},
      {"bool", "Boolean"},      {"logical", "Boolean"}, {"str", "String"},
      {"text", "String"},       {"bytes", "Binary"},    {"hex", "Binary"},
      {"held", "hold"},         {"previous", "hold"},   {"step", "hold"},
      {"discrete", "hold"},     {"constant", "hold"},   {"interpolated", "linear"},
      {"continuous", "linear"}, {"events", "event"},    {"message", "event"}};
  const std::string small = lower_case(word);
  for (const char* course : {"linear", "hold", "event"}) {
    if (small == course) return course;
  }
  for (const char* type : stride::kTypeNames) {
    if (small == lower_case(type) && value_type_named(type)) return type;
  }
  const auto found = kOthers.find(small);
  return found == kOthers.end() ? "" : found->second;
}

[[noreturn]] void refuse_word(const std::string& word) {
  const std::string meant = meant_word(word);
  throw std::invalid_argument(
      "'" + word + "' behind the colon is neither a type nor a course; " +
      (meant.empty() ? "expected NAME [UNIT]: TYPE COURSE, with a type of FMI 3.0 such as Float64, "
                       "Int32, Boolean or String, and linear, hold or event"
                     : "did you mean '" + meant + "'?"));
}

void read_words(const std::string& text, Heading& heading) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const auto type = value_type_named(word);
    const auto course = course_named(word);
    if (!type && !course) refuse_word(word);
    if (type ? heading.type.has_value() : heading.course.has_value()) {
      throw std::invalid_argument("'" + word + "' is a second " + (type ? "type" : "course") +
                                  "; expected one");
    }
    if (type) heading.type = type;
    if (course) heading.course = course;
  }
}

/// The text before the colon, if there is one outside of single quotes.
std::string without_words(const std::string& text, Heading& heading) {
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\'') is_quoted = !is_quoted;
    if (text[i] != ':' || is_quoted) continue;
    read_words(text.substr(i + 1), heading);
    return text.substr(0, i);
  }
  return text;
}

/// Takes "[UNIT]" off the end; an index of an array follows its name without a blank.
void take_unit(std::string& text, std::string& unit) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos || text.back() != ']') return;
  unit = trimmed(std::string_view(text).substr(bracket + 2, text.size() - bracket - 3));
  text = trimmed(std::string_view(text).substr(0, bracket));
}

/// "speed (m/s)" or "speed[m/s]", which is "speed [m/s]"; empty for other names.
std::string with_unit_apart(const std::string& name) {
  const std::size_t open = name.find_first_of("([");
  if (open == std::string::npos || open == 0) return "";
  const char close = name[open] == '(' ? ')' : ']';
  if (name.back() != close || open + 2 >= name.size()) return "";
  const std::string before = trimmed(std::string_view(name).substr(0, open));
  if (!stride::is_structured_name(before)) return "";
  return before + " [" + name.substr(open + 1, name.size() - open - 2) + "]";
}

void check_name(const std::string& name) {
  if (name.empty()) throw std::invalid_argument("a column has no name");
  if (name == kTimeName) {
    throw std::invalid_argument("'time' is the name of the first column; expected another one");
  }
  if (stride::is_structured_name(name)) return;
  if (const std::string meant = with_unit_apart(name); !meant.empty()) {
    throw std::invalid_argument("'" + name + "' is not a name; did you mean '" + meant +
                                "'? A unit of measure stands in brackets, behind a blank");
  }
  const std::string quoted = "'" + name + "'";
  throw std::invalid_argument(
      "\"" + name +
      "\" is not a name of FMI; expected parts of letters, digits and '_', joined by dots" +
      (stride::is_structured_name(quoted) ? ", or anything else in single quotes: " + quoted : ""));
}

}  // namespace

Heading parse_heading(const std::string& text) {
  Heading heading;
  std::string rest = trimmed(without_words(text, heading));
  take_unit(rest, heading.unit);
  heading.name = rest;
  check_name(heading.name);
  return heading;
}

namespace {

/// The unit of time that is meant by another name; empty if none is.
std::string meant_time_unit(const std::string& name) {
  static const std::map<std::string, const char*> kOthers = {
      {"s", "s"},        {"sec", "s"},
      {"secs", "s"},     {"second", "s"},
      {"seconds", "s"},  {"ms", "ms"},
      {"msec", "ms"},    {"millisecond", "ms"},
      {"us", "us"},      {"milliseconds", "ms"},
      {"usec", "us"},    {"\u00b5s", "us"},
      {"\u03bcs", "us"}, {"microseconds", "us"},
      {"ns", "ns"},      {"nsec", "ns"},
      {"min", "min"},    {"nanoseconds", "ns"},
      {"minute", "min"}, {"minutes", "min"},
      {"h", "h"},        {"hr", "h"},
      {"hour", "h"},     {"hours", "h"}};
  const auto found = kOthers.find(lower_case(name));
  return found == kOthers.end() ? "" : found->second;
}

/// "time [s]" for "time (s)", "TIME_s", "t" and the like; empty for what is no time.
std::string meant_time_heading(const std::string& text) {
  const std::string name = trimmed(text);
  const std::size_t end = std::min(name.find_first_of(" ([_/"), name.size());
  const std::string word = lower_case(name.substr(0, end));
  if (word != "time" && word != "t" && word != "times" && word != "timestamp") {
    const std::string unit = meant_time_unit(word);
    return unit.size() > 0 && word.size() > 2 ? "time [" + unit + "]" : "";
  }
  constexpr std::string_view kMarks = " ([_/])";
  const std::size_t first = name.find_first_not_of(kMarks, end);
  if (first == std::string::npos) return kTimeName;
  const std::string unit =
      meant_time_unit(name.substr(first, name.find_last_not_of(kMarks) - first + 1));
  return unit.empty() ? "" : "time [" + unit + "]";
}

}  // namespace

bool is_time_heading(const std::string& text) {
  try {
    parse_time_heading(text);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

std::int64_t parse_time_heading(const std::string& text) {
  static const std::map<std::string, std::int64_t> kUnits = {{"", 1'000'000'000'000},
                                                             {"s", 1'000'000'000'000},
                                                             {"ms", 1'000'000'000},
                                                             {"us", 1'000'000},
                                                             {"ns", 1'000},
                                                             {"min", 60'000'000'000'000},
                                                             {"h", 3'600'000'000'000'000}};
  std::string name = trimmed(text);
  std::string unit;
  take_unit(name, unit);
  const auto found = kUnits.find(unit);
  if ((name == kTimeName || name == "Time") && found != kUnits.end()) return found->second;
  const std::string meant = meant_time_heading(text);
  throw std::invalid_argument("the first column is '" + text +
                              "'; expected 'time', in seconds, or 'time [UNIT]' with s, ms, us, "
                              "ns, min or h" +
                              (meant.empty() ? "" : "; did you mean '" + meant + "'?"));
}

}  // namespace player
