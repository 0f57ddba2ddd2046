#include "master/base/xml/encoding.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <utf8.h>

#include "master/base/error.h"
#include "master/base/text/character_converter.h"
#include "master/base/text/lower_case.h"
#include "master/base/text/readable_text.h"

namespace stride::xml {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";

/// An encoding whose characters are wider than a byte, by how a document in it begins.
struct WideEncoding {
  std::string_view beginning;
  std::size_t mark_size;
  const char* name;
  std::size_t unit_size;  ///< bytes
};

/// Longer beginnings first.
constexpr WideEncoding kWideEncodings[] = {
    {"\xff\xfe\0\0"sv, 4, "UTF-32LE", 4}, {"\0\0\xfe\xff"sv, 4, "UTF-32BE", 4},
    {"<\0\0\0"sv, 0, "UTF-32LE", 4},      {"\0\0\0<"sv, 0, "UTF-32BE", 4},
    {"\xff\xfe"sv, 2, "UTF-16LE", 2},     {"\xfe\xff"sv, 2, "UTF-16BE", 2},
    {"<\0"sv, 0, "UTF-16LE", 2},          {"\0<"sv, 0, "UTF-16BE", 2},
};

const WideEncoding* find_wide_encoding(std::string_view bytes) {
  const auto* const found =
      std::find_if(std::begin(kWideEncodings), std::end(kWideEncodings),
                   [&](const WideEncoding& wide) { return bytes.starts_with(wide.beginning); });
  return found == std::end(kWideEncodings) ? nullptr : found;
}

/// The place of the encoding's name in the XML declaration of a text of which at least the
/// characters of ASCII can be read; nothing if it names none.
std::optional<std::pair<std::size_t, std::size_t>> find_encoding_name(std::string_view text) {
  const std::size_t begin = text.starts_with(kUtf8Mark) ? kUtf8Mark.size() : 0;
  if (!text.substr(begin).starts_with("<?xml")) return std::nullopt;
  const std::string_view declaration = text.substr(0, text.find("?>", begin));
  const std::size_t word = declaration.find("encoding", begin);
  if (word == text.npos) return std::nullopt;
  const std::size_t quote = declaration.find_first_of("'\"", word);
  if (quote == text.npos) return std::nullopt;
  const std::size_t end = declaration.find(declaration[quote], quote + 1);
  return std::pair(quote + 1, std::min(end, declaration.size()) - quote - 1);
}

/// EncName of XML 1.0: iconv would take what follows a "//" for settings.
bool is_encoding_name(std::string_view name) {
  return !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0 &&
         std::ranges::all_of(name, [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
         });
}

/// Whether a document that declares it, and has bytes for characters, can be read as UTF-8 only.
bool counts_as_utf8(const std::string& encoding) {
  constexpr std::string_view kNames[] = {"utf-8", "utf8", "us-ascii", "ascii"};
  constexpr std::string_view kWide[] = {"utf-16", "utf16",          "utf-32",  "utf32",
                                        "ucs-2",  "iso-10646-ucs-", "unicode", "ucs-4"};
  return std::ranges::find(kNames, encoding) != std::end(kNames) ||
         std::ranges::any_of(kWide, [&](auto wide) { return encoding.starts_with(wide); });
}

std::string place_at_end_of(std::string_view text, const std::string& file) {
  const auto line = 1 + static_cast<int>(std::ranges::count(text, '\n'));
  return core::to_text({.where = {file, line}});
}

/// `unit_size`: how many bytes are left out where they are no character.
DecodedText convert(std::string_view bytes, core::CharacterConverter& converter,
                    const std::string& encoding, std::size_t unit_size, const std::string& file) {
  DecodedText decoded;
  for (converter.append(bytes, decoded.text); !bytes.empty();
       converter.append(bytes, decoded.text)) {
    if (decoded.warning.empty()) {
      decoded.warning =
          place_at_end_of(decoded.text, file) +
          fmt::format(
              "what is here is no text in the encoding {} that the file declares: replaced "
              "by \"{}\", here and below",
              encoding, core::kReplacement);
    }
    decoded.text += core::kReplacement;
    bytes.remove_prefix(std::min(unit_size, bytes.size()));
  }
  converter.append_rest(decoded.text);
  return decoded;
}

/// Of which only some bytes are no UTF-8.
DecodedText repair(std::string_view bytes, const std::string& file) {
  core::CharacterConverter windows("WINDOWS-1252");
  DecodedText decoded;
  while (!bytes.empty()) {
    const auto* const invalid = utf8::find_invalid(bytes.begin(), bytes.end());
    decoded.text.append(bytes.begin(), invalid);
    bytes.remove_prefix(static_cast<std::size_t>(invalid - bytes.begin()));
    if (bytes.empty()) break;
    if (decoded.warning.empty()) {
      decoded.warning = place_at_end_of(decoded.text, file) +
                        "what is here is no UTF-8, which the file declares: taken for "
                        "Windows-1252, here and below";
    }
    std::string_view one = bytes.substr(0, 1);
    if (windows.is_open()) windows.append(one, decoded.text);
    if (!one.empty()) decoded.text += core::kReplacement;
    bytes.remove_prefix(1);
  }
  return decoded;
}

DecodedText declared_as_utf8(DecodedText decoded) {
  if (const auto name = find_encoding_name(decoded.text)) {
    decoded.text.replace(name->first, name->second, "UTF-8");
  }
  return decoded;
}

}  // namespace

DecodedText decode(std::string bytes, const std::string& file) {
  if (const WideEncoding* const wide = find_wide_encoding(bytes)) {
    core::CharacterConverter converter(wide->name);
    const std::string_view characters = std::string_view(bytes).substr(wide->mark_size);
    return declared_as_utf8(convert(characters, converter, wide->name, wide->unit_size, file));
  }
  const auto name = find_encoding_name(bytes);
  const std::string encoding =
      name ? core::lower_case(bytes.substr(name->first, name->second)) : "utf-8";
  if (bytes.starts_with(kUtf8Mark) || counts_as_utf8(encoding)) {
    return utf8::find_invalid(bytes.begin(), bytes.end()) == bytes.end()
               ? DecodedText{std::move(bytes), ""}
               : repair(bytes, file);
  }
  core::CharacterConverter converter(is_encoding_name(encoding) ? encoding.c_str() : "");
  if (!is_encoding_name(encoding) || !converter.is_open()) {
    core::fail_input({.where = {file, 1}}, fmt::format("the encoding '{}' is not known", encoding),
                     "save it as XML with the encoding UTF-8");
  }
  return declared_as_utf8(convert(bytes, converter, encoding, 1, file));
}

}  // namespace stride::xml
