// The words that stride was called with.
#ifndef STRIDE_MASTER_FRONT_CLI_PROGRAM_COMMAND_LINE_H
#define STRIDE_MASTER_FRONT_CLI_PROGRAM_COMMAND_LINE_H

#include "master/observe/recorders/provenance.h"

namespace stride::cli {

/// As they were typed, and where.
const recorders::Command& command_line();
/// To be called when the program begins.
void note_command_line(int argc, const char* const* argv);

}  // namespace stride::cli

#endif
