// Requests and answers as the bits that are on the air.
#ifndef STRIDE_UNITS_READER_ANSWER_H
#define STRIDE_UNITS_READER_ANSWER_H

#include <cstdint>
#include <optional>

#include "units/nfc/commands.h"
#include "units/nfc/frame.h"

namespace reader {

/// A request with CRC_A and parity.
nfc::Bits request_bits(nfc::Command command, const nfc::Bytes& arguments);

/// What the sensor says to a command.
struct Answer {
  nfc::Status status = nfc::Status::kOk;
  std::uint32_t identifier = 0;  ///< after identify
  double temperature = 0.0;      ///< after read_temperature [degC]
};

/// Nothing unless parity, CRC and status are right and the data are what the command calls for: an
/// answer with another status than kOk has no data.
std::optional<Answer> parse_answer(nfc::Command command, const nfc::Bits& bits);

}  // namespace reader

#endif
