// Which components of a scenario have hosts, processes of their own, why, and with which options.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_HOSTING_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_HOSTING_H

#include <csignal>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/run/context/run_options.h"
#include "master/loader/network/remote_unit.h"
#include "master/loader/process/host_options.h"
#include "master/system/declaration/run_settings.h"

namespace stride::scenario {

/// The options of the command line.
struct HostRequest {
  std::vector<std::string> hosted;  ///< globs over components
  std::string unit_timeout;         ///< seconds, for all hosted units
  bool no_sandbox = false;
  std::vector<std::string> places;  ///< "COMPONENT=PLACE", a glob and where its units run
  const volatile std::sig_atomic_t* interrupted = nullptr;  ///< ends a wait for a machine
};

/// The host of a component.
struct Hosting {
  std::string reason;     ///< human-readable
  std::string snapshots;  ///< why it takes snapshots, or why it takes none, likewise
  isolation::HostOptions options;
  std::optional<remote::RemoteSpec> remote{};  ///< none: on this machine
};

/// The settings of each component, from the scenario and the command line, which has precedence.
/// Throws core::Error (Input) for a pattern that matches none, and for a number that is none.
std::vector<HostSettings> host_settings(std::span<const std::string> components, HostRules rules,
                                        const HostRequest& request);

/// The hosts that the settings require and, where they leave it open, those whose snapshots a run
/// with this policy needs; the latter are logged. A host takes snapshots where these are needed, or
/// where the settings demand them.
std::vector<std::optional<Hosting>> choose_hostings(
    std::span<const core::ComponentDeclaration> components, const core::StepPolicyType& policy,
    std::span<const HostSettings> settings);

/// Throws core::Error (Input) if there is a time limit but no host to which it applies.
void check_unit_timeout(const HostRequest& request,
                        std::span<const std::optional<Hosting>> hostings);

}  // namespace stride::scenario

#endif
