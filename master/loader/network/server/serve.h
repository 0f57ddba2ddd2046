// A host for the units of a master elsewhere, behind two pipes: `stride serve`.
#ifndef STRIDE_MASTER_LOADER_NETWORK_SERVER_SERVE_H
#define STRIDE_MASTER_LOADER_NETWORK_SERVER_SERVE_H

#include <csignal>

#include "master/loader/network/server/serve_options.h"

namespace stride::remote {

/// Serves one unit, until the master or the link has ended or a signal has set `interrupted`.
/// Nothing else may write to `out`. Throws core::Error (Input) for FMUs that are not there, before
/// anything is sent, and core::Error (Run) for a peer that does not keep to the protocol or has
/// another version of it.
void serve(int in, int out, const ServeOptions& options,
           const volatile std::sig_atomic_t& interrupted);

}  // namespace stride::remote

#endif
