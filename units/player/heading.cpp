#include "units/player/heading.h"

#include <map>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace player {
namespace {

constexpr std::string_view kBlanks = " \t";

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

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

/// Whether all words say what the values are.
bool read_words(const std::string& text, Heading& heading) {
  std::istringstream words(text);
  bool has_any = false;
  for (std::string word; words >> word; has_any = true) {
    const auto type = value_type_named(word);
    const auto course = course_named(word);
    if (!type && !course) return false;
    if (type ? heading.type.has_value() : heading.course.has_value()) return false;
    if (type) heading.type = type;
    if (course) heading.course = course;
  }
  return has_any;
}

/// The text before a colon with such words behind it.
std::string without_words(const std::string& text, Heading& heading) {
  const std::size_t colon = text.rfind(':');
  Heading read;
  if (colon == std::string::npos || !read_words(text.substr(colon + 1), read)) return text;
  heading = read;
  return text.substr(0, colon);
}

/// Takes "[UNIT]" off the end; an index of an array follows its name without a blank.
void take_unit(std::string& text, std::string& unit) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos || text.back() != ']') return;
  unit = trimmed(std::string_view(text).substr(bracket + 2, text.size() - bracket - 3));
  text = trimmed(std::string_view(text).substr(0, bracket));
}

}  // namespace

Heading parse_heading(const std::string& text) {
  Heading heading;
  std::string rest = trimmed(without_words(text, heading));
  take_unit(rest, heading.unit);
  heading.name = rest;
  if (heading.name.empty()) throw std::invalid_argument("a column has no name");
  return heading;
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
  if ((name == "time" || name == "Time") && found != kUnits.end()) return found->second;
  throw std::invalid_argument("the first column is '" + text +
                              "'; expected 'time', in seconds, or 'time [UNIT]' with s, ms, us, "
                              "ns, min or h");
}

}  // namespace player
