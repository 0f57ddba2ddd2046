// Hosted units: each runs in a separate process, its host.
#ifndef STRIDE_MASTER_LOADER_PROCESS_HOSTED_UNIT_H
#define STRIDE_MASTER_LOADER_PROCESS_HOSTED_UNIT_H

#include <memory>
#include <string>

#include "master/engine/port/unit.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/process/host_options.h"

namespace stride::isolation {

/// Makes an instance in a host, a process of its own: its library is loaded there and nowhere else,
/// but for a bare one, which is asked for its description here (importer::Fmu). To be called while
/// this process has one thread.
///
/// The instance behaves as one of fmu->instantiate(), with the same errors. Beyond those, a call of
/// a unit whose process ends, or which takes longer than its limit, throws core::Error of the kind
/// Run with the call, the simulated time, how the process ended and the unit's last lines, and so
/// does each call after it but terminate() and free(), which do nothing then. `options.warn_after`
/// is also how long a call may take before it is logged. Nothing of the process stays when the unit
/// is destroyed, or when this process ends, however it does.
std::unique_ptr<core::Unit> instantiate(std::shared_ptr<importer::Fmu> fmu, const std::string& name,
                                        importer::InstanceOptions options, HostOptions host);

}  // namespace stride::isolation

#endif
