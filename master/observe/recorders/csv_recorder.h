#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_CSV_RECORDER_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_CSV_RECORDER_H

#include <filesystem>
#include <vector>

#include "master/base/files/output_file.h"
#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"

namespace stride::recorders {

/// signals.csv: the header "time,component.variable [unit],…" (each element of an array in a column
/// of its own), then a row for each communication point. Times are exact, numbers read back as the
/// same bits, so equal runs make equal files.
class CsvRecorder : public core::Observer {
 public:
  /// The system must outlive the recorder. Throws core::Error if the file cannot be created; later
  /// calls throw it if it cannot be written.
  CsvRecorder(const core::System& system, std::filesystem::path file,
              core::OutputFile::Existing existing = core::OutputFile::Existing::Emptied);

  /// At a communication point, behind on_start(): as core::OutputFile::persist().
  void persist(core::StateArchive& state);
  core::OutputFile& file() { return file_; }

  void on_start(std::span<const core::Signal> signals) override;
  void on_communication_point(Time time) override;
  void on_finish() override;

 private:
  struct Column {
    const core::ValueBlock* block;
    std::size_t element;
  };
  const core::System& system_;
  core::OutputFile file_;
  std::vector<Column> columns_;
};

}  // namespace stride::recorders

#endif
