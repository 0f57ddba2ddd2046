// What the robot is to do, read from an XML file. README.md describes the format.
#ifndef STRIDE_UNITS_READER_PROGRAM_H
#define STRIDE_UNITS_READER_PROGRAM_H

#include <cstdint>
#include <string>
#include <vector>

#include <stride/time.h>

#include "units/nfc/commands.h"
#include "units/nfc/frame.h"
#include "units/reader/motion.h"

namespace reader {

/// The antenna is on from `on` until just before `off`.
struct AntennaInterval {
  stride::Time on;
  stride::Time off;
  double power;  ///< of the carrier [W]
};

/// A command to the sensor.
struct ProgramCommand {
  stride::Time at;  ///< when it is to be sent
  nfc::Command command;
  nfc::Bytes arguments;
  stride::Duration timeout;  ///< from its end until the answer has to begin
  std::uint32_t bit_rate;    ///< [kbit/s]
};

/// Times do not fall in any of the three lists; waypoints' times rise, intervals do not overlap,
/// and each command begins in an interval.
struct Program {
  std::vector<std::string> axes;
  std::vector<Waypoint> waypoints;
  std::vector<AntennaInterval> antenna;
  std::vector<ProgramCommand> commands;
};

/// The power of the carrier at an instant [W], 0 while the antenna is off.
double carrier_power(const Program& program, stride::Time time);

/// Throws std::runtime_error with the file, the line and what was expected there.
Program load_program(const std::string& path);

/// The same for a text; `name` stands for the file in error messages.
Program parse_program(const std::string& text, const std::string& name);

/// What a command is called in programs and messages, such as "read_temperature".
std::string name_of(nfc::Command command);

}  // namespace reader

#endif
