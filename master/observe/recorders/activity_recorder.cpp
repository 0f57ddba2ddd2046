#include "master/observe/recorders/activity_recorder.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/state_archive.h"
#include "master/observe/recorders/signal_text.h"

namespace stride::recorders {

const char* name(core::Activity::Kind kind) {
  using Kind = core::Activity::Kind;
  switch (kind) {
    case Kind::Idle:
      return "idle";
    case Kind::Event:
      return "event";
    case Kind::EarlyReturn:
      return "early return";
    case Kind::Rejection:
      return "rejection";
    case Kind::Undone:
      return "undone";
  }
  return "";
}

ActivityRecorder::ActivityRecorder(const core::System& system, std::filesystem::path file,
                                   core::OutputFile::Existing existing)
    : system_(system), file_(std::move(file), {}, existing) {}

void ActivityRecorder::on_start(std::span<const core::Signal> /*signals*/) {
  file_.write("time,until,component,kind\n");
  for (const core::Component& component : system_.components()) {
    fields_.push_back(fmt::format(",{},", csv_field(component.name)));
  }
}

void ActivityRecorder::on_activity(const core::Activity& activity) {
  file_.set_time(activity.until);
  file_.write_seconds(activity.from);
  file_.write(',');
  file_.write_seconds(activity.until);
  file_.write(fields_[activity.component]);
  file_.write(std::string_view(name(activity.kind)));
  file_.write('\n');
}

void ActivityRecorder::persist(core::StateArchive& state) {
  state.mark("activity");
  file_.persist(state);
}

void ActivityRecorder::on_finish() { file_.close(); }

}  // namespace stride::recorders
