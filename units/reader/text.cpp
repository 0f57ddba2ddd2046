#include "units/reader/text.h"

namespace reader {

std::string hexadecimal(std::uint32_t number) {
  std::string text = "0x";
  for (int shift = 28; shift >= 0; shift -= 4) text += "0123456789ABCDEF"[number >> shift & 0xF];
  return text;
}

}  // namespace reader
