// What can be done about a unit whose state cannot be saved or restored.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_STATE_HINT_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_STATE_HINT_H

#include <string>
#include <string_view>

namespace stride::importer {

/// How the unit runs without its own functions for its state.
std::string state_hint(const std::string& unit);
/// Likewise for a failure that is in one of these functions, as its text says; else empty.
std::string state_hint(std::string_view failure, const std::string& unit);

}  // namespace stride::importer

#endif
