#include "units/mujoco_world/robot/encoding.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include <iconv.h>

namespace mujoco_world {
namespace {

using namespace std::string_view_literals;

bool begins_with(std::string_view text, std::string_view beginning) {
  return text.substr(0, beginning.size()) == beginning;
}

std::string find_declared_encoding(std::string_view text) {
  if (!begins_with(text, "<?xml")) return "";
  const std::string_view declaration = text.substr(0, text.find("?>"));
  const std::size_t word = declaration.find("encoding");
  if (word == declaration.npos) return "";
  const std::size_t quote = declaration.find_first_of("'\"", word);
  if (quote == declaration.npos) return "";
  const std::size_t end = declaration.find(declaration[quote], quote + 1);
  std::string name(declaration.substr(quote + 1, end - quote - 1));
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

/// What iconv calls it; empty for UTF-8. What has bytes for characters is no UTF-16, even if it
/// says so.
std::string find_encoding(std::string_view bytes) {
  if (begins_with(bytes, "\xff\xfe") || begins_with(bytes, "\xfe\xff")) return "UTF-16";
  if (begins_with(bytes, "<\0"sv)) return "UTF-16LE";
  if (begins_with(bytes, "\0<"sv)) return "UTF-16BE";
  const std::string name = find_declared_encoding(bytes);
  const bool is_utf8 = name == "UTF-8" || name == "UTF8" || name == "US-ASCII" || name == "ASCII" ||
                       begins_with(name, "UTF-16");
  return is_utf8 ? "" : name;
}

[[noreturn]] void fail(const std::string& file, std::ptrdiff_t line, const std::string& problem) {
  throw std::runtime_error(file + ":" + std::to_string(line) + ": " + problem +
                           ": save it with the encoding UTF-8");
}

struct CloseConverter {
  void operator()(iconv_t converter) const { ::iconv_close(converter); }
};
using Converter = std::unique_ptr<std::remove_pointer_t<iconv_t>, CloseConverter>;

Converter open_converter(const std::string& encoding, const std::string& file) {
  // iconv takes what follows a slash for settings
  const bool is_name = encoding.find('/') == encoding.npos;
  const iconv_t converter =
      is_name ? ::iconv_open("UTF-8", encoding.c_str()) : reinterpret_cast<iconv_t>(-1);
  if (converter == reinterpret_cast<iconv_t>(-1)) {
    fail(file, 1, "the encoding '" + encoding + "' is not known");
  }
  return Converter(converter);
}

}  // namespace

std::string decode_xml(const std::string& bytes, const std::string& file) {
  const std::string encoding = find_encoding(bytes);
  if (encoding.empty()) return bytes;
  const Converter converter = open_converter(encoding, file);
  auto* from = const_cast<char*>(bytes.data());  // iconv does not write there
  std::size_t left = bytes.size();
  std::string text;
  while (left > 0) {
    std::array<char, 4096> piece;
    char* to = piece.data();
    std::size_t room = piece.size();
    const std::size_t result = ::iconv(converter.get(), &from, &left, &to, &room);
    text.append(piece.data(), to);
    if (result == static_cast<std::size_t>(-1) && errno != E2BIG) {
      fail(file, 1 + std::count(text.begin(), text.end(), '\n'),
           "what is here is no text in the encoding " + encoding);
    }
  }
  return text;
}

}  // namespace mujoco_world
