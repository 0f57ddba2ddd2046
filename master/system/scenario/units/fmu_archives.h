// Units as archives, so that they can be put elsewhere.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_FMU_ARCHIVES_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_UNITS_FMU_ARCHIVES_H

#include <filesystem>

#include "master/base/archive/temporary_folder.h"
#include "master/base/error.h"

namespace stride::scenario {

/// Makes archives of units that are folders or libraries; removes them with this object.
class FmuArchives {
 public:
  /// The archive of the unit that is found by this source, or the unit itself if it is one. Throws
  /// core::Error as find_unit() and importer::pack() do.
  std::filesystem::path operator()(const std::filesystem::path& source,
                                   const core::Location& where);

 private:
  archive::TemporaryFolder folder_;
  int count_ = 0;
};

}  // namespace stride::scenario

#endif
