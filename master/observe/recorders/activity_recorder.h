#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_ACTIVITY_RECORDER_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_ACTIVITY_RECORDER_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/base/files/output_file.h"
#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"

namespace stride::recorders {

/// The word of activity.csv: "early return".
const char* name(core::Activity::Kind kind);

/// activity.csv: "time,until,component,kind", a row for each thing that a component did beside
/// ordinary steps, in the order in which they ended. Times are exact.
class ActivityRecorder : public core::Observer {
 public:
  /// As CsvRecorder.
  ActivityRecorder(const core::System& system, std::filesystem::path file,
                   core::OutputFile::Existing existing = core::OutputFile::Existing::Emptied);

  /// At a communication point, behind on_start(): as core::OutputFile::persist().
  void persist(core::StateArchive& state);
  core::OutputFile& file() { return file_; }

  void on_start(std::span<const core::Signal> signals) override;
  bool watches_activities() const override { return true; }
  void on_activity(const core::Activity& activity) override;
  void on_finish() override;

 private:
  const core::System& system_;
  core::OutputFile file_;
  std::vector<std::string> fields_;  ///< ",component," by component
};

}  // namespace stride::recorders

#endif
