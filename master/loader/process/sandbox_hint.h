#ifndef STRIDE_MASTER_LOADER_PROCESS_SANDBOX_HINT_H
#define STRIDE_MASTER_LOADER_PROCESS_SANDBOX_HINT_H

#include <string>
#include <string_view>

#include "master/loader/process/host_options.h"

namespace stride::isolation {

/// How to find out whether a unit has failed because it is in a sandbox; empty if it is in none, or
/// if the text of the failure does not look like it.
std::string sandbox_hint(std::string_view text, const std::string& unit, const HostOptions& host);

}  // namespace stride::isolation

#endif
