// Numbers as text, for reports and messages.
#ifndef STRIDE_UNITS_READER_TEXT_H
#define STRIDE_UNITS_READER_TEXT_H

#include <cstdint>
#include <string>

namespace reader {

/// The shortest decimal that reads back as the same number; never a decimal comma.
std::string shortest(double number);

/// Such as "0x0A2B3C4D".
std::string hexadecimal(std::uint32_t number);

}  // namespace reader

#endif
