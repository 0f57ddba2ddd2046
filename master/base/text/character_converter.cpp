#include "master/base/text/character_converter.h"

#include <array>
#include <cerrno>
#include <cstddef>

namespace stride::core {

CharacterConverter::CharacterConverter(const char* encoding)
    : handle_(::iconv_open("UTF-8", encoding)) {}

CharacterConverter::~CharacterConverter() {
  if (is_open()) ::iconv_close(handle_);
}

void CharacterConverter::append(std::string_view& bytes, std::string& text) {
  auto* from = const_cast<char*>(bytes.data());  // iconv does not write there
  std::size_t left = bytes.size();
  std::size_t result = 0;
  do {
    std::array<char, 4096> piece;
    char* to = piece.data();
    std::size_t room = piece.size();
    result = ::iconv(handle_, &from, &left, &to, &room);
    text.append(piece.data(), to);
  } while (result == static_cast<std::size_t>(-1) && errno == E2BIG);
  bytes.remove_prefix(bytes.size() - left);
}

void CharacterConverter::append_rest(std::string& text) {
  std::array<char, 64> piece;
  char* to = piece.data();
  std::size_t room = piece.size();
  ::iconv(handle_, nullptr, nullptr, &to, &room);
  text.append(piece.data(), to);
}

}  // namespace stride::core
