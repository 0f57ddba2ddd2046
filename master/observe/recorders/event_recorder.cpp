#include "master/observe/recorders/event_recorder.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/state_archive.h"
#include "master/observe/recorders/signal_text.h"

namespace stride::recorders {

EventRecorder::EventRecorder(const core::System& system, std::filesystem::path file,
                             core::OutputFile::Existing existing)
    : system_(system), file_(std::move(file), {}, existing) {}

void EventRecorder::on_start(std::span<const core::Signal> /*signals*/) {
  file_.write("time,index,component,variable,direction,payload,content\n");
  for (const core::Component& component : system_.components()) {
    std::vector<std::string>& fields = fields_.emplace_back();
    for (const core::Variable& variable : component.description->variables) {
      fields.push_back(fmt::format(",{},{},", csv_field(component.name), csv_field(variable.name)));
    }
  }
}

void EventRecorder::on_message(const core::Message& message) {
  file_.set_time(message.time);
  file_.write_seconds(message.time);
  file_.write(',');
  file_.write_number(message.index);
  file_.write(fields_[message.id.component][message.id.variable]);
  file_.write(message.received ? std::string_view("received,") : std::string_view("sent,"));
  if (message.block != nullptr) write_payload(message);
  file_.write(',');
  if (!message.content.empty()) file_.write(csv_field(message.content));
  file_.write('\n');
}

void EventRecorder::on_intervention(Time time, std::uint32_t index, core::VariableId id,
                                    std::string_view text) {
  file_.set_time(time);
  file_.write_seconds(time);
  file_.write(',');
  file_.write_number(index);
  file_.write(fields_[id.component][id.variable]);
  file_.write("intervention,,");
  file_.write(csv_field(text));
  file_.write('\n');
}

void EventRecorder::write_payload(const core::Message& message) {
  const core::Variable& variable = system_.variable(message.id);
  if (variable.type == core::ValueType::String) {
    return file_.write(csv_field(fmt::format(
        "{}", fmt::join(message.block->strings().subspan(message.first, variable.size), " "))));
  }
  for (std::size_t i = 0; i < variable.size; ++i) {
    if (i > 0) file_.write(' ');
    write_csv(file_, *message.block, message.first + i);
  }
}

void EventRecorder::persist(core::StateArchive& state) {
  state.mark("events");
  file_.persist(state);
}

void EventRecorder::on_finish() { file_.close(); }

}  // namespace stride::recorders
