// What the robot's program expects of an answer, and whether it got it.
#ifndef STRIDE_UNITS_READER_EXPECTATION_H
#define STRIDE_UNITS_READER_EXPECTATION_H

#include <cstdint>
#include <optional>
#include <string>

#include <stride/nfc/commands.h>

#include "units/reader/answer.h"

namespace reader {

/// The data are looked at where the status is Ok.
struct Expectation {
  bool answer = true;  ///< false: no intact answer must come
  nfc::Status status = nfc::Status::Ok;
  std::optional<std::uint32_t> identifier;  ///< of identify
  std::optional<double> lowest;   ///< of read_temperature, of each sample of read_log [degC]
  std::optional<double> highest;  ///< likewise
  std::uint32_t samples = 0;      ///< of read_log: at least so many
};

/// `answer` is what came in the end, if it was intact.
bool is_met(const Expectation& expectation, nfc::Command command,
            const std::optional<Answer>& answer);

/// Such as "ok 20 to 23 degC" or "no answer"; without a comma, for tables.
std::string text_of(const Expectation& expectation);

/// Such as "ok 21.49 degC".
std::string text_of(nfc::Command command, const Answer& answer);

}  // namespace reader

#endif
