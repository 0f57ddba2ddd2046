// The application protocol between reader and sensor: a request is a command byte and its
// arguments, an answer is a status byte and data, both in standard frames that end with CRC_A.
#ifndef STRIDE_UNITS_NFC_COMMANDS_H
#define STRIDE_UNITS_NFC_COMMANDS_H

#include <cstdint>

namespace nfc {

enum class Command : std::uint8_t {
  kIdentify = 0x01,  ///< answer: the sensor's 32-bit identifier, most significant byte first
  kReadTemperature =
      0x02,        ///< answer: the last conversion as a signed 16-bit count of 1/100 degC, likewise
  kSetLed = 0x03,  ///< argument: one byte, 0 off, 1 on; the answer has no data
};

enum class Status : std::uint8_t {
  kOk = 0x00,
  kUnknownCommand = 0x01,
  kBadArgument = 0x02,
};

}  // namespace nfc

#endif
