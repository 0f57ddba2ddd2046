// A table of values over time, as people write it (docs/stimuli.md).
#ifndef STRIDE_UNITS_PLAYER_TABLE_H
#define STRIDE_UNITS_PLAYER_TABLE_H

#include <string>

#include "units/player/stimuli.h"

namespace player {

/// Reads the text of a file: the first column is the time, each other one an input. Throws
/// std::runtime_error "FILE:LINE: column 'NAME': …" for what cannot be a table.
Stimuli parse_table(const std::string& text, const std::string& file);

}  // namespace player

#endif
