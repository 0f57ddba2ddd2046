#include "master/observe/capture/stimuli_file.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/state_archive.h"
#include "master/base/time_text.h"
#include "master/observe/recorders/signal_text.h"

namespace stride::capture {
namespace {

constexpr core::OutputFile::Hints kHints{
    .create = "name a file that you may write: --capture COMPONENT=FILE",
    .write = "make room on the disk that the file is on; the lines before are complete"};

/// Always in quotation marks, so that an empty text is not taken for nothing.
void append_quoted(std::string& text, std::string_view value) {
  recorders::quote_csv(value, [&](char c) { text += c; });
}

core::ValueBlock start_values(const core::Variable& variable) {
  try {
    core::ValueBlock values = core::parse_start(variable, variable.start);
    if (values.size() == variable.size) return values;
  } catch (const std::invalid_argument&) {  // it names none
  }
  return core::ValueBlock(variable.type, variable.size);
}

/// The triggered clock that it belongs to, if any.
std::string clock_name(const core::UnitDescription& description, const core::Variable& variable) {
  for (const core::ValueReference reference : variable.clocks) {
    const core::Variable& clock = description.variables[*description.find(reference)];
    if (is_stimulus(clock)) return clock.name;
  }
  return {};
}

}  // namespace

bool is_stimulus(const core::Variable& variable) {
  return variable.causality == core::Causality::Input && !variable.is_time_based_clock();
}

StimuliFile::StimuliFile(std::filesystem::path path, const Origin& origin,
                         core::OutputFile::Existing existing)
    : file_(std::move(path), kHints, existing) {
  const core::UnitDescription& description = *origin.description;
  fmt::format_to(std::back_inserter(pending_),
                 "stride stimuli,1\nunit,{}\ncomponent,{}\nsystem,{}\n",
                 recorders::csv_field(description.model_name),
                 recorders::csv_field(origin.component), recorders::csv_field(origin.system));
  for (const core::Variable& variable : description.variables) {
    if (is_stimulus(variable)) add_input(description, variable);
  }
}

void StimuliFile::add_input(const core::UnitDescription& description, const core::Variable& input) {
  std::vector<std::size_t> sizes;
  for (const core::Dimension& dimension : input.dimensions) sizes.push_back(dimension.size);
  fmt::format_to(std::back_inserter(pending_), "input,{},{},{},{},{},{}",
                 recorders::csv_field(input.name), core::name(input.type),
                 core::name(input.variability), recorders::csv_field(input.unit),
                 recorders::csv_field(clock_name(description, input)), fmt::join(sizes, " "));
  if (input.type != core::ValueType::Clock) add_elements(input, start_values(input), 0);
  pending_ += '\n';
  for (const auto& [item, number] : input.items) {
    fmt::format_to(std::back_inserter(pending_), "item,{},{},{}\n",
                   recorders::csv_field(input.name), recorders::csv_field(item), number);
  }
}

void StimuliFile::add_elements(const core::Variable& variable, const core::ValueBlock& values,
                               std::size_t first) {
  for (std::size_t i = 0; i < variable.size; ++i) {
    pending_ += ',';
    if (variable.type == core::ValueType::String) {
      append_quoted(pending_, values.strings()[first + i]);
    } else {
      pending_ += core::element_text(values, first + i);
    }
  }
}

void StimuliFile::add_start_value(const core::Variable& variable, const core::ValueBlock& values,
                                  std::size_t first) {
  fmt::format_to(std::back_inserter(pending_), "set,{}", recorders::csv_field(variable.name));
  add_elements(variable, values, first);
  pending_ += '\n';
}

void StimuliFile::add_skip(Duration max_skip) {
  const bool is_endless = max_skip == Duration::max();
  fmt::format_to(std::back_inserter(pending_), "skip,{}\n",
                 is_endless ? "for ever" : core::to_text(max_skip));
}

void StimuliFile::add_tolerance(const core::Variable& output, double tolerance) {
  fmt::format_to(std::back_inserter(pending_), "tolerance,{},{}\n",
                 recorders::csv_field(output.name), tolerance);
}

void StimuliFile::end_head(Time start) {
  pending_ += "time,event,variable,value\n";
  has_head_ = true;
  commit(start);
}

void StimuliFile::add_moment(Time time, std::string_view event) {
  pending_ += core::to_text(time);
  pending_ += ',';
  pending_ += event;
  pending_ += ',';
}

void StimuliFile::add_value(Time time, std::string_view event, const core::Variable& variable,
                            const core::ValueBlock& values, std::size_t first) {
  add_moment(time, event);
  pending_ += recorders::csv_field(variable.name);
  add_elements(variable, values, first);
  pending_ += '\n';
}

void StimuliFile::add_tick(Time time, std::string_view event, const core::Variable& clock) {
  add_moment(time, event);
  pending_ += recorders::csv_field(clock.name);
  pending_ += ",\n";
}

void StimuliFile::add_step(Time from, Time to) {
  add_moment(from, "step");
  pending_ += ',';
  pending_ += core::to_text(to);
  pending_ += '\n';
}

void StimuliFile::commit(Time time) {
  committed_ = time;
  file_.set_time(time);
  file_.write(pending_);
  pending_.clear();
}

void StimuliFile::persist(core::StateArchive& state) {
  file_.persist(state);
  state.value(pending_);
  state.value(has_head_);
  state.value(committed_);
}

void StimuliFile::close(std::string_view ending) {
  if (!has_head_) end_head(committed_);
  pending_.clear();
  add_moment(committed_, "end");
  pending_ += ',';
  append_quoted(pending_, ending);
  pending_ += '\n';
  commit(committed_);
  file_.close();
}

}  // namespace stride::capture
