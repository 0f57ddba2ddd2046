#ifndef STRIDE_TESTS_UNITS_READER_PROGRAMS_H
#define STRIDE_TESTS_UNITS_READER_PROGRAMS_H

#include <string>

#include "units/reader/program.h"

namespace reader::tests {

constexpr stride::Duration kPicosecond{1};

inline stride::Time at(double seconds) { return stride::time_from_seconds(seconds); }

/// The antenna is on from 1 s to 9 s.
inline Program program_with(const std::string& commands) {
  return parse_program(R"(<reader-program version="1">
      <antenna on="1" off="9" power="0.5"/>)" +
                           commands + "</reader-program>",
                       "p.xml");
}

}  // namespace reader::tests

#endif
