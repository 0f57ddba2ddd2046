// What `stride new` writes.
#ifndef STRIDE_MASTER_FRONT_CLI_NEW_STARTERS_H
#define STRIDE_MASTER_FRONT_CLI_NEW_STARTERS_H

#include <cstdint>
#include <span>
#include <string_view>

namespace stride::cli {

enum class Starter : std::uint8_t { Scenario, Unit, SystemcUnit };

/// In its name, NAME stands for that of the user's; in the text @NAME@, and likewise other words.
struct StarterFile {
  std::string_view name, text;
};

std::span<const StarterFile> starter_files(Starter starter);

}  // namespace stride::cli

#endif
