// Requests and answers as the bits that are on the air.
#ifndef STRIDE_UNITS_READER_ANSWER_H
#define STRIDE_UNITS_READER_ANSWER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <stride/nfc/commands.h>
#include <stride/nfc/frame.h>
#include <stride/time.h>

namespace reader {

/// A request with CRC_A and parity.
nfc::Bits request_bits(nfc::Command command, const nfc::Bytes& arguments);

/// One line of the sensor's log.
struct Sample {
  std::uint16_t age = 0;     ///< when the answer was made [s]
  double temperature = 0.0;  ///< [degC]
};

/// The sensor's answer to a command.
struct Answer {
  nfc::Status status = nfc::Status::Ok;
  std::uint32_t identifier = 0;  ///< after identify
  double temperature = 0.0;      ///< after read_temperature [degC]
  std::uint32_t sample_count = 0;
  std::array<Sample, nfc::kLogSamples>
      samples{};  ///< after read_log, the first sample_count, oldest first
};

/// Nothing unless parity, CRC and status are right and the data are what the command calls for: an
/// answer with another status than Ok has no data. What a command that is not in nfc::Command
/// calls for is unknown, so any data will do.
std::optional<Answer> parse_answer(nfc::Command command, const nfc::Bits& bits);

/// How long the longest answer to a command is on the air, at the lowest bit rate.
stride::Duration longest_answer(nfc::Command command);

}  // namespace reader

#endif
