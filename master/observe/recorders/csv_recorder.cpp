#include "master/observe/recorders/csv_recorder.h"

#include <utility>

#include <fmt/format.h>

#include "master/base/message_text.h"
#include "master/base/state_archive.h"
#include "master/observe/recorders/signal_text.h"

namespace stride::recorders {

CsvRecorder::CsvRecorder(const core::System& system, std::filesystem::path file,
                         core::OutputFile::Existing existing)
    : system_(system), file_(std::move(file), {}, existing) {}

void CsvRecorder::on_start(std::span<const core::Signal> signals) {
  file_.write("time");
  for (const core::Signal& signal : signals) {
    const core::Variable& variable = system_.variable(signal.id);
    for (std::size_t i = 0; i < variable.size; ++i) {
      columns_.push_back({signal.block, signal.first + i});
      file_.write(',');
      file_.write(csv_field(core::with_unit(column_name(system_, signal.id, i), variable.unit)));
    }
  }
  file_.write('\n');
}

void CsvRecorder::on_communication_point(Time time) {
  file_.set_time(time);
  file_.write_seconds(time);
  for (const Column& column : columns_) {
    file_.write(',');
    write_csv(file_, *column.block, column.element);
  }
  file_.write('\n');
}

void CsvRecorder::persist(core::StateArchive& state) {
  state.mark("signals");
  file_.persist(state);
}

void CsvRecorder::on_finish() { file_.close(); }

}  // namespace stride::recorders
