// The values of an instance's variables: what may be read and set, and when.
#include <algorithm>

#include <stride/value_text.h>

#include "interfaces/unit/instance.h"

namespace stride::kit {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

const Slot& Instance::slot(fmi3ValueReference reference, Type type) const {
  require_unit();
  if (reference >= table_->size()) {
    throw Misuse("there is no variable with the value reference " + std::to_string(reference));
  }
  const Slot& found = table_->slot(reference);
  const bool same = found.type == type || (found.type == Type::Enumeration && type == Type::Int64);
  if (!same) {
    throw Misuse("variable '" + table_->row(reference).name + "' is of the type " +
                 name(found.type) + ", not " + name(type));
  }
  return found;
}

/// Checks a whole set call before any of it is done, so that a refused one changes nothing.
void Instance::check_writable(const fmi3ValueReference references[], std::size_t count, Type type,
                              std::size_t size) const {
  std::size_t total = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& found = slot(references[i], type);
    total += found.size;
    if (mode_ == IntermediateUpdateMode && !is_intermediate(references[i])) {
      throw Misuse("variable '" + table_->row(references[i]).name +
                   "' is not among the requiredIntermediateVariables of the instance");
    }
    if ((found.settable & mode_) != 0) continue;
    const std::string legal = mode_names(found.settable);
    throw Misuse("variable '" + table_->row(references[i]).name + "' cannot be set in " +
                 mode_names(mode_) +
                 (legal.empty() ? ", nor in any other state" : ", only in " + legal));
  }
  if (total != size) {
    throw Misuse(std::string("nValues is too ") + (total > size ? "small" : "large"));
  }
}

void Instance::get_binary(const fmi3ValueReference references[], std::size_t count,
                          std::size_t sizes[], fmi3Binary values[], std::size_t size) {
  refresh();
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& from = slot(references[i], Type::Binary);
    if (at + from.size > size) throw Misuse("nValues is too small");
    const auto* elements = static_cast<const Binary*>(from.data);
    for (std::size_t k = 0; k < from.size; ++k) {
      sizes[at] = elements[k].size();
      values[at++] = elements[k].data();
    }
  }
  if (at != size) throw Misuse("nValues is too large");
}

void Instance::set_binary(const fmi3ValueReference references[], std::size_t count,
                          const std::size_t sizes[], const fmi3Binary values[], std::size_t size) {
  check_writable(references, count, Type::Binary, size);
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& to = table_->slot(references[i]);
    auto* elements = static_cast<Binary*>(to.data);
    for (std::size_t k = 0; k < to.size; ++k, ++at) {
      if (sizes[at] == 0) {
        elements[k].clear();
      } else {
        elements[k].assign(values[at], values[at] + sizes[at]);
      }
    }
  }
  inputs_changed_ = true;
  note_discrete_change(references, count);
}

std::string Instance::describe_message(fmi3ValueReference reference, const fmi3Byte value[],
                                       std::size_t size, std::size_t capacity) const {
  slot(reference, Type::Binary);
  const Variable& row = table_->row(reference);
  std::string text;
  try {
    text = unit_->describe_message(row, size == 0 ? Binary() : Binary(value, value + size));
  } catch (const std::exception& failure) {
    importer_.message(fmi3Warning, LogWarnings,
                      "a value of '" + row.name + "' cannot be described: " + failure.what());
  }
  std::replace_if(text.begin(), text.end(), is_control, ' ');
  return text.substr(0, whole_characters(text, capacity));
}

void Instance::get_output_derivatives(const fmi3ValueReference references[], std::size_t count,
                                      const fmi3Int32 orders[], double values[], std::size_t size) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& output = slot(references[i], Type::Float64);
    const Variable& row = table_->row(references[i]);
    if (row.derivative == nullptr || orders[i] != 1) {
      throw Misuse("output '" + row.name + "' has no derivative of order " +
                   std::to_string(orders[i]));
    }
    if (at + output.size > size) throw Misuse("nValues is too small");
    for (std::size_t k = 0; k < output.size; ++k) values[at++] = row.derivative[k];
  }
  if (at != size) throw Misuse("nValues is too large");
}

}  // namespace stride::kit
