#include "master/loader/fmu/instance/log_references.h"

#include <charconv>
#include <string_view>
#include <utility>

namespace stride::importer {
namespace {

constexpr std::string_view kReferenceTypes = "ribs";

/// Where the reference that begins at `at` ends, behind its second #, and its variable's name; an
/// empty name if it is none.
std::pair<std::size_t, std::string> read_reference(std::string_view message, std::size_t at,
                                                   const VariableName& name_of) {
  const std::size_t end = message.find('#', at + 1);
  if (end == std::string_view::npos || end < at + 3) return {at, ""};
  const char type = message[at + 1];
  if (kReferenceTypes.find(type) == std::string_view::npos) return {at, ""};
  std::uint32_t reference = 0;
  const char* const last = message.data() + end;
  const auto [stop, error] = std::from_chars(message.data() + at + 2, last, reference);
  if (error != std::errc{} || stop != last) return {at, ""};
  return {end + 1, name_of(type, reference)};
}

}  // namespace

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
