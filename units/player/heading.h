// The heading of a column of a table: its name, and what its values are.
#ifndef STRIDE_UNITS_PLAYER_HEADING_H
#define STRIDE_UNITS_PLAYER_HEADING_H

#include <cstdint>
#include <optional>
#include <string>

#include "units/player/values.h"

namespace player {

/// What a column has between its rows.
enum class Course {
  Linear,  ///< the line from row to row; a second row of the same time is a jump
  Hold,    ///< the value of the row before
  Event,   ///< nothing: each row is a message
};

struct Heading {
  std::string name;
  std::string unit;  ///< of measure; empty if none is named
  std::optional<Type> type;
  std::optional<Course> course;
};

/// Reads "NAME", "NAME [UNIT]", and either followed by ": TYPE COURSE", or one of the two, in any
/// order. The name is a structured one of FMI. Throws std::invalid_argument that says how to write
/// what was meant.
Heading parse_heading(const std::string& text);

/// Whether parse_time_heading() takes it.
bool is_time_heading(const std::string& text);
/// That of the first column, "time" or "time [UNIT]": how many picoseconds its unit has. Throws
/// std::invalid_argument that contains what was expected.
std::int64_t parse_time_heading(const std::string& text);

}  // namespace player

#endif
