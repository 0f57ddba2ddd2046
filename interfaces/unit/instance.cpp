#include "interfaces/unit/instance.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <stride/idle.h>

#include "interfaces/unit/model_description.h"
#include "interfaces/unit/xml_writer.h"

namespace stride::kit {
namespace {

std::uint8_t log_category(const char* wanted) {
  std::string known;
  for (const auto& [category, name] : kLogCategories) {
    if (wanted != nullptr && std::strcmp(wanted, name) == 0) return category;
    known.append(known.empty() ? "" : ", ").append(name);
  }
  throw Misuse("there is no log category '" + std::string(wanted != nullptr ? wanted : "") +
               "', only " + known);
}

void check_range(const Variable& row) {
  if (!row.min && !row.max) return;
  if (row.type != Type::Float64 || row.causality != Causality::Parameter) return;
  const auto* values = static_cast<const double*>(row.data);
  for (std::size_t i = 0; i < row.size; ++i) {
    const bool low = row.min && values[i] < *row.min;
    const bool high = row.max && values[i] > *row.max;
    if (!low && !high) continue;
    throw std::out_of_range(
        "parameter '" + row.name + "' is " + to_text(values[i]) +
        (row.unit.empty() ? "" : " " + row.unit) + ", expected " +
        (low ? "at least " + to_text(*row.min) : "at most " + to_text(*row.max)));
  }
}

}  // namespace

void Importer::message(fmi3Status status, LogCategory category, const std::string& text) const {
  if (log != nullptr && (log_categories & category) != 0) {
    log(environment, status, name(category), text.c_str());
  }
}

Instance::Instance(Importer importer, const std::string& token) : importer_(std::move(importer)) {
  build();
  token_ = instantiation_token(unit_factory().name, *unit_, *table_);
  if (token != token_) {
    throw Misuse("the instantiation token is '" + token + "', this unit's is '" + token_ +
                 "': the model description belongs to another build of the unit or "
                 "to other resources; pack the unit again");
  }
  check_intermediate_variables();
  if (!unit_->lists_state()) return;
  serialized_.emplace(StateIdentity{unit_factory().name, token_, layout_of_state(*unit_),
                                    importer_.event_mode_used});
}

void Instance::build() {
  mode_ = Instantiated;  // from here on, so that there is a unit in every other mode
  idle_.reset();
  table_.reset();
  unit_.reset();
  unit_ = unit_factory().make({importer_.resources, importer_.instance_name, importer_.results});
  unit_->set_results(importer_.results);
  unit_->set_logger([this](Severity severity, const std::string& text) {
    const bool warning = severity == Severity::Warning;
    importer_.message(warning ? fmi3Warning : fmi3OK, warning ? LogWarnings : LogEvents, text);
  });
  table_.emplace(*unit_, time_seconds_);
  if (unit_->info().promises_idle) idle_.emplace(*unit_, *table_);
  time_seconds_ = 0;
  stop_.reset();
  next_event_.reset();
  inputs_changed_ = true;
  event_pending_ = warned_of_inputs_ = warned_of_outputs_ = false;
}

void Instance::reset() { build(); }

void Instance::set_logging(bool on, const fmi3String names[], std::size_t count) {
  std::uint8_t named = count == 0 ? kAllLogCategories : 0;
  for (std::size_t i = 0; i < count; ++i) named |= log_category(names[i]);
  const std::uint8_t others = importer_.log_categories & ~named;
  importer_.log_categories = on ? others | named : others;
}

void Instance::enter_initialization_mode(Time start, std::optional<Time> stop) {
  if (stop && *stop < start) throw Misuse("the stop time is before the start time");
  start_ = start;
  stop_ = stop;
  set_time(start);
  mode_ = InitializationMode;
  inputs_changed_ = true;
}

void Instance::exit_initialization_mode() {
  refresh();
  mode_ = importer_.event_mode_used ? EventMode : StepMode;
  if (!importer_.event_mode_used) begin_own_events();
}

void Instance::terminate() {
  unit_->terminate();
  mode_ = Terminated;
}

void Instance::recompute_outputs() {
  if (mode_ == InitializationMode) {
    for (const Variable& row : unit_->variables()) check_range(row);
    forget_intervals();
    unit_->initialize(start_);
  }
  unit_->update_outputs();
  inputs_changed_ = false;
}

Instance::UpdateOutcome Instance::update_discrete_states() {
  for (Clock* clock : table_->output_clocks()) clock->clear();
  if (next_event_ && *next_event_ <= time_) next_event_.reset();
  Event event(time_, next_event_);
  unit_->event(event);
  next_event_ = event.next();
  for (Clock* clock : table_->input_clocks()) clock->clear();
  unit_->update_outputs();
  inputs_changed_ = false;
  return {event.iterates() || any_clock_ticked(), event.terminates(), next_event_};
}

void Instance::check_intermediate_variables() const {
  for (const fmi3ValueReference reference : importer_.intermediate_variables) {
    if (reference < table_->size() && table_->row(reference).intermediate) continue;
    throw Misuse("the value reference " + std::to_string(reference) +
                 " is not that of an intermediate variable (intermediateUpdate)");
  }
}

bool Instance::is_intermediate(fmi3ValueReference reference) const {
  const auto& known = importer_.intermediate_variables;
  return std::binary_search(known.begin(), known.end(), reference);
}

void Instance::require_unit() const {
  if (!unit_ || !table_) throw Misuse("the last reset failed; reset it again or free it");
}

void Instance::require_idle_promises() const {
  require_unit();
  if (!idle_)
    throw Misuse("this unit never promises to be idle (it has no " STRIDE_IDLE_MANIFEST ")");
}

void Instance::enable_idle_skipping(double max_skip) {
  require_idle_promises();
  const bool is_endless = max_skip > kMaxSeconds;
  const Duration longest = is_endless ? Duration::max() : duration_of_seconds(max_skip);
  if (longest <= Duration{}) {
    throw Misuse("maxSkip is " + to_text(max_skip) +
                 " s, expected at least the picosecond that times are counted in");
  }
  idle_->enable(longest);
}

void Instance::set_idle_tolerances(const fmi3ValueReference outputs[], std::size_t count,
                                   const double tolerances[], std::size_t size) {
  require_idle_promises();
  if (count != size) throw Misuse("nTolerances must be nOutputs");
  for (std::size_t i = 0; i < count; ++i) {
    slot(outputs[i], Type::Float64);
    const std::string& name = table_->row(outputs[i]).name;
    if (!idle_->has_tolerance(outputs[i])) {
      throw Misuse("variable '" + name + "' is not an output with a tolerance in the manifest");
    }
    if (tolerances[i] > 0 && std::isfinite(tolerances[i])) continue;
    throw Misuse("the tolerance of '" + name + "' is " + to_text(tolerances[i]) +
                 ", expected more than 0");
  }
  for (std::size_t i = 0; i < count; ++i) idle_->set_tolerance(outputs[i], tolerances[i]);
}

Time Instance::idle_until() const {
  require_idle_promises();
  const auto longest = idle_->max_skip();
  if (!longest || event_pending_) return time_;
  Time until = std::min(unit_->idle_until(time_), later(time_, *longest));
  if (next_event_) until = std::min(until, *next_event_);
  if (const auto& step = unit_->info().maximum_step) until = std::min(until, later(time_, *step));
  return std::max(until, time_);
}

}  // namespace stride::kit
