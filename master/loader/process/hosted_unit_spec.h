#ifndef STRIDE_MASTER_LOADER_PROCESS_HOSTED_UNIT_SPEC_H
#define STRIDE_MASTER_LOADER_PROCESS_HOSTED_UNIT_SPEC_H

#include <memory>
#include <string>
#include <vector>

#include "master/base/archive/temporary_folder.h"
#include "master/base/child_process/sandbox.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/process/host_options.h"

namespace stride::isolation {

/// What a hosted unit is instantiated from.
struct HostedUnitSpec {
  std::shared_ptr<importer::Fmu> fmu;
  std::string name;
  importer::InstanceOptions options;
  HostOptions host;
  /// For a unit in a sandbox: $TMPDIR, since that of others is closed to it.
  std::unique_ptr<archive::TemporaryFolder> temporary{};

  /// Whether its states are snapshots of its process.
  bool has_snapshots() const { return host.takes_snapshots && !fmu->description()->can_save_state; }
};

/// Where the unit may change files: in a sandbox nowhere else.
std::vector<WritableFolder> writable_folders(const HostedUnitSpec& spec);

}  // namespace stride::isolation

#endif
