// Texts of any character encoding, as UTF-8.
#ifndef STRIDE_MASTER_BASE_TEXT_CHARACTER_CONVERTER_H
#define STRIDE_MASTER_BASE_TEXT_CHARACTER_CONVERTER_H

#include <string>
#include <string_view>

#include <iconv.h>

namespace stride::core {

/// From an encoding that iconv knows.
class CharacterConverter {
 public:
  explicit CharacterConverter(const char* encoding);
  ~CharacterConverter();
  CharacterConverter(const CharacterConverter&) = delete;
  CharacterConverter& operator=(const CharacterConverter&) = delete;

  /// Whether iconv knows the encoding; nothing else may be called if not.
  bool is_open() const { return handle_ != reinterpret_cast<iconv_t>(-1); }

  /// Appends the characters up to the end or to the first bytes that are none, and takes them off.
  void append(std::string_view& bytes, std::string& text);

  /// Appends what it keeps back of encodings whose characters may be combined with the next one.
  void append_rest(std::string& text);

 private:
  iconv_t handle_;
};

}  // namespace stride::core

#endif
