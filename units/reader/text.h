// Numbers as text, for reports and messages.
#ifndef STRIDE_UNITS_READER_TEXT_H
#define STRIDE_UNITS_READER_TEXT_H

#include <cstdint>
#include <string>

namespace reader {

/// Such as "0x0A2B3C4D".
std::string hexadecimal(std::uint32_t number);

}  // namespace reader

#endif
