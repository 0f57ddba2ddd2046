#include "master/importer/fmi2/fmi2_log.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

namespace stride::importer {
namespace {

constexpr std::string_view kTypes = "ribs";
constexpr std::string_view kBeforeConversion = " #+-0123456789.*'hlLqjzt";

bool has_count_conversion(std::string_view format) {
  for (std::size_t at = format.find('%'); at != std::string_view::npos; at = format.find('%', at)) {
    at = format.find_first_not_of(kBeforeConversion, at + 1);
    if (at == std::string_view::npos) return false;
    if (format[at] == 'n') return true;
    ++at;  // also over the second of %%
  }
  return false;
}

/// Where the reference that begins at `at` ends, behind its second #, and its variable's name; an
/// empty name if it is none.
std::pair<std::size_t, std::string> read_reference(std::string_view message, std::size_t at,
                                                   const VariableName& name_of) {
  const std::size_t end = message.find('#', at + 1);
  if (end == std::string_view::npos || end < at + 3) return {at, ""};
  const char type = message[at + 1];
  if (kTypes.find(type) == std::string_view::npos) return {at, ""};
  fmi2ValueReference reference = 0;
  const char* const last = message.data() + end;
  const auto [stop, error] = std::from_chars(message.data() + at + 2, last, reference);
  if (error != std::errc{} || stop != last) return {at, ""};
  return {end + 1, name_of(type, reference)};
}

}  // namespace

std::string format_message(const char* message, std::va_list arguments) {
  if (message == nullptr) return "";
  if (std::strchr(message, '%') == nullptr || has_count_conversion(message)) return message;
  std::array<char, 512> start{};
  std::va_list again;
  va_copy(again, arguments);
  const int size = std::vsnprintf(start.data(), start.size(), message, arguments);
  std::string text;
  if (size < 0) {
    text = message;
  } else if (static_cast<std::size_t>(size) < start.size()) {
    text.assign(start.data(), static_cast<std::size_t>(size));
  } else {
    text.resize(static_cast<std::size_t>(size));
    std::vsnprintf(text.data(), text.size() + 1, message, again);
  }
  va_end(again);
  return text;
}

std::string name_variables(const std::string& message, const VariableName& name_of) {
  std::string text;
  for (std::size_t at = 0; at < message.size();) {
    if (message[at] != '#') {
      text += message[at++];
    } else if (message.compare(at, 2, "##") == 0) {
      text += '#';
      at += 2;
    } else if (const auto [end, name] = read_reference(message, at, name_of); !name.empty()) {
      text += name;
      at = end;
    } else {
      text += message[at++];
    }
  }
  return text;
}

}  // namespace stride::importer
