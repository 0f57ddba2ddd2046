#include "master/study/replay/device_record.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/csv_reader.h"
#include "master/base/message_text.h"
#include "master/engine/model/array_element.h"
#include "master/engine/model/item_text.h"

namespace stride::replay {
namespace {

/// Columns of signals.csv -> the output.
std::map<std::string, std::string> outputs_by_title(const std::string& component,
                                                    const core::UnitDescription& device) {
  std::map<std::string, std::string> outputs;
  for (const core::Variable& variable : device.variables) {
    if (!is_recorded(device, variable)) continue;
    for (std::size_t i = 0; i < variable.size; ++i) {
      const std::string name = core::element_name(variable, i);
      outputs[core::with_unit(component + "." + name, variable.unit)] = name;
    }
  }
  return outputs;
}

void read_signals(const std::filesystem::path& file,
                  const std::map<std::string, std::string>& outputs, DeviceRecord& record) {
  core::CsvReader reader(file);
  if (!reader.next()) return;
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < reader.fields().size(); ++i) {
    const auto output = outputs.find(reader.fields()[i].value());
    if (output == outputs.end()) continue;
    columns.push_back(i);
    record.outputs.push_back(output->second);
  }
  const std::size_t width = reader.fields().size();
  while (reader.next()) {
    if (reader.fields().size() != width) reader.fail("this row has another number of fields");
    const auto [place, is_new] = record.values.try_emplace(reader.fields()[0].value());
    if (is_new) record.times.push_back(place->first);
    place->second.clear();
    for (const std::size_t column : columns) {
      place->second.push_back(reader.fields()[column].value());
    }
  }
}

void read_events(const std::filesystem::path& file, const std::string& component,
                 DeviceRecord& record) {
  constexpr std::size_t kColumns = 7;
  core::CsvReader reader(file);
  reader.next();
  while (reader.next()) {
    const auto& fields = reader.fields();
    if (fields.size() != kColumns) reader.fail("this is no row of messages");
    if (fields[2].value() != component || fields[4].text != "sent") continue;
    record.sent.push_back(
        {fields[0].value(), fields[1].value(), fields[3].value(), fields[5].value()});
  }
}

std::string text_of(const DeviceRecord::Message& message) {
  return fmt::format("{} at {} s", message.output, message.time);
}

/// The places of the outputs that both have, in the replay and in the run.
std::vector<std::pair<std::size_t, std::size_t>> common_outputs(const DeviceRecord& run,
                                                                const DeviceRecord& replay) {
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::size_t i = 0; i < replay.outputs.size(); ++i) {
    const auto same = std::ranges::find(run.outputs, replay.outputs[i]);
    if (same == run.outputs.end()) continue;
    places.emplace_back(i, static_cast<std::size_t>(same - run.outputs.begin()));
  }
  return places;
}

/// Times of files, [s].
bool is_later(const std::string& time, const std::string& other) {
  return std::strtod(time.c_str(), nullptr) > std::strtod(other.c_str(), nullptr);
}

bool is_writable(const std::string& text) {
  return std::ranges::none_of(text, [](unsigned char c) { return c < ' '; });
}

/// Whether a check can demand it.
bool is_demandable(const core::Variable& variable, const std::string& value) {
  if (core::is_real(variable.type)) return value.find_first_of("nN") == std::string::npos;
  return is_writable(value);
}

/// As a check reads it: an item has its name, which another one may have as its number.
std::string check_text(const core::Variable& variable, const std::string& value) {
  if (variable.type != core::ValueType::Enumeration) return value;
  return core::item_name(std::strtoll(value.c_str(), nullptr, 10), variable.items);
}

}  // namespace

DeviceRecord read_device_record(const std::filesystem::path& signals,
                                const std::filesystem::path& events, const std::string& component,
                                const core::UnitDescription& device) {
  DeviceRecord record;
  if (!signals.empty()) read_signals(signals, outputs_by_title(component, device), record);
  if (!events.empty()) read_events(events, component, record);
  return record;
}

std::optional<std::string> first_difference(const DeviceRecord& run, const DeviceRecord& replay,
                                            const StimuliSummary& stimuli) {
  std::vector<DeviceRecord::Message> sent = run.sent;
  std::erase_if(sent, [&](const auto& message) { return is_later(message.time, stimuli.end); });
  const auto [mine, other] = std::ranges::mismatch(sent, replay.sent);
  if (mine != sent.end() || other != replay.sent.end()) {
    return fmt::format("the message of {}", text_of(mine != sent.end() ? *mine : *other));
  }
  const auto& exact = stimuli.max_skip ? stimuli.event_instants : stimuli.instants;
  const auto common = common_outputs(run, replay);
  for (const std::string& time : replay.times) {
    const auto before = run.values.find(time);
    if (before == run.values.end() || !exact.contains(time)) continue;
    const auto& now = replay.values.at(time);
    for (const auto& [place, other] : common) {
      if (now[place] == before->second[other]) continue;
      return fmt::format("{} at {} s, {} and not {}", replay.outputs[place], time, now[place],
                         before->second[other]);
    }
  }
  return std::nullopt;
}

std::vector<Expectation> expectations_of(const DeviceRecord& replay,
                                         const core::UnitDescription& device,
                                         const std::string& tolerance) {
  std::vector<Expectation> made;
  std::map<std::string, std::string> last;
  for (std::size_t i = 0; i < replay.outputs.size() && !replay.times.empty(); ++i) {
    last[replay.outputs[i]] = replay.values.at(replay.times.back())[i];
  }
  for (const core::Variable& variable : device.variables) {
    if (is_reported(device, variable)) {
      const auto count =
          std::ranges::count(replay.sent, variable.name, &DeviceRecord::Message::output);
      made.push_back({Expectation::Kind::Count, variable.name, std::to_string(count)});
    }
    if (!is_recorded(device, variable)) continue;
    for (std::size_t i = 0; i < variable.size; ++i) {
      const auto value = last.find(core::element_name(variable, i));
      if (value == last.end() || !is_demandable(variable, value->second)) continue;
      made.push_back({Expectation::Kind::Final, value->first, check_text(variable, value->second),
                      core::is_real(variable.type) ? tolerance : ""});
    }
  }
  return made;
}

}  // namespace stride::replay
