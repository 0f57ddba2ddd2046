#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_EVENT_RECORDER_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_EVENT_RECORDER_H

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "master/base/files/output_file.h"
#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"

namespace stride::recorders {

/// events.csv: "time,index,component,variable,direction,payload,content", a row for each message
/// that a component sends or receives, at its exact time. The payload of Binary is written in
/// hexadecimal digits, the elements of an array are separated by blanks; a bare clock has none. The
/// content is the component's description of the payload; empty where it gives none.
class EventRecorder : public core::Observer {
 public:
  /// As CsvRecorder.
  EventRecorder(const core::System& system, std::filesystem::path file,
                core::OutputFile::Existing existing = core::OutputFile::Existing::Emptied);

  /// At a communication point, behind on_start(): as core::OutputFile::persist().
  void persist(core::StateArchive& state);
  core::OutputFile& file() { return file_; }

  void on_start(std::span<const core::Signal> signals) override;
  bool wants_content() const override { return true; }
  void on_message(const core::Message& message) override;
  void on_intervention(Time time, std::uint32_t index, core::VariableId id,
                       std::string_view text) override;
  void on_finish() override;

 private:
  void write_payload(const core::Message& message);

  const core::System& system_;
  core::OutputFile file_;
  std::vector<std::vector<std::string>>
      fields_;  ///< ",component,variable," by component and variable
};

}  // namespace stride::recorders

#endif
