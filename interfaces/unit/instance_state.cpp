// The state of an instance: what the kit keeps, the values of all variables, and what the unit
// lists. What the importer has chosen (the stop time, logging, callbacks) is not part of it.
#include <stdexcept>

#include "interfaces/unit/instance.h"

namespace stride::kit {

void Instance::require_state() const {
  require_unit();
  if (!unit_->lists_state()) {
    throw Misuse("this unit cannot save its state (canGetAndSetFMUState is false)");
  }
}

void Instance::save(SavedState& saved) const {
  require_state();
  saved.was_serialized = false;
  StateWriter writer(saved.bytes);
  writer.write(mode_);
  writer.write(time_);
  writer.write(start_);
  writer.write(next_event_);
  writer.write(inputs_changed_);
  writer.write(event_pending_);
  if (idle_) idle_->save(writer);
  for (std::size_t i = 1; i < table_->size(); ++i) {
    const Variable& row = table_->row(i);
    visit(row.type, row.data, [&](const auto* elements) {
      for (std::size_t k = 0; k < row.size; ++k) writer.write(elements[k]);
    });
  }
  for (const StateItem& item : unit_->state_items()) item.save(item.object, writer);
  unit_->save_state(writer);
}

void Instance::load(const SavedState& saved) {
  StateReader reader(saved.bytes.data(), saved.bytes.size());
  reader.read(mode_);
  reader.read(time_);
  reader.read(start_);
  reader.read(next_event_);
  reader.read(inputs_changed_);
  reader.read(event_pending_);
  if (idle_) idle_->load(reader);
  time_seconds_ = to_seconds(time_);
  for (std::size_t i = 1; i < table_->size(); ++i) {
    const Variable& row = table_->row(i);
    visit(row.type, row.data, [&](auto* elements) {
      for (std::size_t k = 0; k < row.size; ++k) reader.read(elements[k]);
    });
  }
  for (const StateItem& item : unit_->state_items()) item.load(item.object, reader);
  unit_->load_state(reader);
  if (reader.left() != 0) {
    throw std::runtime_error("the saved state is longer than what load_state() reads");
  }
}

/// Only of a state that was serialised is it not known whether the unit takes it.
void Instance::restore(const SavedState& saved) {
  require_state();
  if (!saved.was_serialized) return load(saved);
  SavedState before;
  save(before);
  try {
    load(saved);
  } catch (const std::exception& failure) {
    const std::string why = failure.what();
    load(before);
    throw Misuse("this unit cannot take the state, and is as it was before: " + why);
  }
}

std::size_t Instance::serialized_size(const SavedState& saved) const {
  require_state();
  return serialized_->size(saved.bytes);
}

void Instance::serialize(const SavedState& saved, std::uint8_t* bytes) const {
  require_state();
  serialized_->write(saved.bytes, bytes);
}

void Instance::deserialize(const std::uint8_t* bytes, std::size_t size, SavedState& state) const {
  require_state();
  const std::size_t begin = serialized_->check(bytes, size);
  state.bytes.assign(bytes + begin, bytes + size);
  state.was_serialized = true;
}

}  // namespace stride::kit
