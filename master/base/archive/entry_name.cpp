#include "master/base/archive/entry_name.h"

#include <algorithm>
#include <string_view>

#include <utf8.h>

#include "master/base/text/character_converter.h"

namespace stride::archive {
namespace {

/// "\x80" to "\xa7" are letters in CP437; in Windows-1252 hardly any of them is in a name.
bool has_letter_of_cp437(std::string_view bytes) {
  return std::ranges::any_of(bytes,
                             [](unsigned char byte) { return byte >= 0x80 && byte <= 0xa7; });
}

}  // namespace

std::string entry_name(std::string bytes) {
  if (bytes.find('/') == bytes.npos) std::ranges::replace(bytes, '\\', '/');
  if (utf8::find_invalid(bytes.begin(), bytes.end()) == bytes.end()) return bytes;
  core::CharacterConverter converter(has_letter_of_cp437(bytes) ? "CP437" : "WINDOWS-1252");
  if (!converter.is_open()) return bytes;
  std::string_view rest = bytes;
  std::string name;
  converter.append(rest, name);
  return rest.empty() ? name : bytes;
}

}  // namespace stride::archive
