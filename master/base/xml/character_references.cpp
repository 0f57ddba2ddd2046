#include "master/base/xml/character_references.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <utility>

namespace stride::xml {
namespace {

constexpr std::pair<std::string_view, std::string_view> kOpaque[] = {
    {"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};

/// The end of the comment, CDATA section or processing instruction that begins at `at`; otherwise
/// `at`.
std::size_t opaque_end(std::string_view text, std::size_t at) {
  for (const auto& [begin, mark] : kOpaque) {
    if (!text.substr(at).starts_with(begin)) continue;
    const std::size_t end = text.find(mark, at + begin.size());
    return end == text.npos ? text.size() : end + mark.size();
  }
  return at;
}

bool is_xml_character(std::uint32_t code) {
  const auto is_between = [&](std::uint32_t first, std::uint32_t last) {
    return first <= code && code <= last;
  };
  return code == '\t' || code == '\n' || code == '\r' || is_between(0x20, 0xD7FF) ||
         is_between(0xE000, 0xFFFD) || is_between(0x10000, 0x10FFFF);
}

/// The name in "&name;", of which `rest` is what follows "&"; empty if it is no such reference.
std::string_view entity_name(std::string_view rest) {
  const auto is_of_name = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
  };
  const auto end = std::ranges::find_if_not(rest, is_of_name);
  if (end == rest.end() || *end != ';') return {};
  return rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
}

bool is_known_entity(std::string_view name) {
  constexpr std::string_view kKnown[] = {"amp", "lt", "gt", "apos", "quot"};
  return std::ranges::find(kKnown, name) != std::end(kKnown);
}

/// `rest`: what follows "&#".
bool is_good(std::string_view rest) {
  const bool is_hexadecimal = rest.starts_with('x');
  if (is_hexadecimal) rest.remove_prefix(1);
  const std::string_view digits = rest.substr(0, rest.find(';'));
  if (digits.size() == rest.size()) return false;
  std::uint32_t code = 0;
  const char* const last = digits.data() + digits.size();
  const auto [end, error] = std::from_chars(digits.data(), last, code, is_hexadecimal ? 16 : 10);
  return error == std::errc() && end == last && is_xml_character(code);
}

}  // namespace

std::optional<std::size_t> find_bad_reference(std::string_view text) {
  for (std::size_t at = 0; (at = text.find_first_of("<&", at)) != text.npos;) {
    const std::size_t end = opaque_end(text, at);
    if (text.substr(at).starts_with("&#") && !is_good(text.substr(at + 2))) return at;
    if (text[at] == '&') {
      const std::string_view name = entity_name(text.substr(at + 1));
      if (!name.empty() && !is_known_entity(name)) return at;
    }
    at = std::max(end, at + 1);
  }
  return std::nullopt;
}

std::optional<std::size_t> find_bad_character(std::string_view text) {
  const auto is_bad = [](char c) {
    return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r';
  };
  const auto found = std::ranges::find_if(text, is_bad);
  if (found == text.end()) return std::nullopt;
  return static_cast<std::size_t>(found - text.begin());
}

}  // namespace stride::xml
