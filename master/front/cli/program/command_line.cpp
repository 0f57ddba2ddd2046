#include "master/front/cli/program/command_line.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace stride::cli {
namespace {

recorders::Command typed;

}  // namespace

const recorders::Command& command_line() { return typed; }

void note_command_line(int argc, const char* const* argv) {
  std::error_code ignored;  // a working folder that was removed has no path
  typed = {{argv + std::min(argc, 1), argv + argc}, std::filesystem::current_path(ignored)};
}

}  // namespace stride::cli
