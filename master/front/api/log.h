// Where messages go.
#ifndef STRIDE_MASTER_FRONT_API_LOG_H
#define STRIDE_MASTER_FRONT_API_LOG_H

#include <stride/master.h>

namespace stride::api {

/// To the function; null: to the standard error stream.
void set_log(stride_log log, void* user);
/// The latter, unless set_log() has been called: spdlog's own logger writes to the standard output.
void set_default_log();

}  // namespace stride::api

#endif
