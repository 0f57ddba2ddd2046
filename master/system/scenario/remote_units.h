// Components whose units run on other machines.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_REMOTE_UNITS_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_REMOTE_UNITS_H

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "master/loader/network/remote_unit.h"
#include "master/system/declaration/run_settings.h"
#include "master/system/declaration/scenario.h"
#include "master/system/scenario/hosting.h"

namespace stride::scenario {

/// What the settings say of a component with this source, which need not exist, unless it is sent.
/// Throws core::Error (Input).
remote::RemoteSpec remote_spec(const RemoteSettings& settings, const std::filesystem::path& source);

/// The settings of the hosts of a scenario's components, for units that are loaded: none where they
/// say of no unit that it is elsewhere, so that mistakes in them are looked for later.
std::vector<HostSettings> hosts_for_loading(const Scenario& scenario, const HostRequest& request);

/// What is known of a unit that stays elsewhere: a hash of its description.
std::string description_digest(const importer::Fmu& fmu);

/// Under which a description that was read is kept: units of one key are the same.
std::filesystem::path key_of(const remote::RemoteSpec& spec);

}  // namespace stride::scenario

#endif
