// Identifier codes of VCD files.
#ifndef STRIDE_MASTER_BASE_TEXT_VCD_CODE_H
#define STRIDE_MASTER_BASE_TEXT_VCD_CODE_H

#include <cstdint>
#include <string>

namespace stride::core {

/// The code with this number, to the base of the 94 printable characters.
inline std::string vcd_code(std::uint64_t number) {
  std::string code;
  do {
    code += static_cast<char>('!' + number % 94);
    number /= 94;
  } while (number != 0);
  return code;
}

}  // namespace stride::core

#endif
