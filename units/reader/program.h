// What the robot is to do, read from an XML file. README.md describes the format.
#ifndef STRIDE_UNITS_READER_PROGRAM_H
#define STRIDE_UNITS_READER_PROGRAM_H

#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "units/reader/command.h"
#include "units/reader/motion.h"
#include "units/reader/variation.h"

namespace reader {

/// The antenna is on from `on` until just before `off`.
struct AntennaInterval {
  stride::Time on;
  stride::Time off;
  double power;  ///< of the carrier [W]
};

/// Times do not fall in any of the three lists; waypoints' times rise, intervals do not overlap,
/// and each command begins in an interval.
struct Program {
  std::vector<std::string> axes;
  std::vector<Waypoint> waypoints;
  std::vector<AntennaInterval> antenna;
  std::vector<ProgramCommand> commands;
  Variation variation;  ///< with one number per axis
};

/// The power of the carrier at an instant [W], 0 while the antenna is off.
double carrier_power(const Program& program, stride::Time time);

/// When the carrier that is on at `time` goes off; nothing if there is none then. An interval that
/// begins where the one before it ends does not interrupt the carrier.
std::optional<stride::Time> carrier_end(const Program& program, stride::Time time);

/// Throws std::runtime_error with the file, the line and what was expected there.
Program load_program(const std::string& path);

/// The same for a text; `name` is the file in error messages.
Program parse_program(const std::string& text, const std::string& name);

}  // namespace reader

#endif
