// A command of the robot's program.
#ifndef STRIDE_UNITS_READER_COMMAND_H
#define STRIDE_UNITS_READER_COMMAND_H

#include <cstdint>

#include <stride/nfc/commands.h>
#include <stride/nfc/frame.h>
#include <stride/time.h>

#include "units/reader/expectation.h"
#include "units/xml/element.h"

namespace reader {

/// What is to be sent to the sensor, and what is expected of it.
struct ProgramCommand {
  stride::Time at;       ///< when it is to be sent
  nfc::Command command;  ///< any byte, if the program gives the bytes
  nfc::Bytes arguments;
  stride::Duration timeout;   ///< from its end until the answer has to begin
  std::uint32_t bit_rate;     ///< [kbit/s]
  std::uint32_t retries = 0;  ///< how often it is sent again without an intact answer
  stride::Duration pause{};   ///< before each of them
  Expectation expectation;
};

/// Reads a <command>. Throws as xml::Element does.
ProgramCommand parse_command(const xml::Element& element);

}  // namespace reader

#endif
