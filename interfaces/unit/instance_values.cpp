// The values of an instance's variables: what may be read and set, and when.
#include <algorithm>

#include <stride/value_text.h>

#include "interfaces/unit/instance.h"

namespace stride::kit {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

}  // namespace

void refuse_count(std::size_t needed, std::size_t given) {
  throw Misuse(std::string("nValues is too ") + (needed > given ? "small" : "large"));
}

void Instance::refuse_access(fmi3ValueReference reference, Type type) const {
  require_unit();
  if (reference >= table_->size()) {
    throw Misuse("there is no variable with the value reference " + std::to_string(reference));
  }
  const Variable& row = table_->row(reference);
  throw Misuse("variable '" + row.name + "' is of the type " + name(row.type) + ", not " +
               name(type));
}

void Instance::refuse_to_set(fmi3ValueReference reference) const {
  const Variable& row = table_->row(reference);
  if (mode_ == IntermediateUpdateMode && !is_intermediate(reference)) {
    throw Misuse("variable '" + row.name +
                 "' is not among the requiredIntermediateVariables of the instance");
  }
  const std::string legal = mode_names(table_->slot(reference).settable);
  throw Misuse("variable '" + row.name + "' cannot be set in " + mode_names(mode_) +
               (legal.empty() ? ", nor in any other state" : ", only in " + legal));
}

void Instance::check_intermediate(const fmi3ValueReference references[], std::size_t count) const {
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_intermediate(references[i])) refuse_to_set(references[i]);
  }
}

void Instance::get_binary(const fmi3ValueReference references[], std::size_t count,
                          std::size_t sizes[], fmi3Binary values[], std::size_t size) {
  refresh();
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& from = slot(references[i], Type::Binary);
    if (at + from.size > size) refuse_count(at + from.size, size);
    const auto* elements = static_cast<const Binary*>(from.data);
    for (std::size_t k = 0; k < from.size; ++k) {
      sizes[at] = elements[k].size();
      values[at++] = elements[k].data();
    }
  }
  if (at != size) refuse_count(at, size);
}

void Instance::set_binary(const fmi3ValueReference references[], std::size_t count,
                          const std::size_t sizes[], const fmi3Binary values[], std::size_t size) {
  check_writable(references, count, Type::Binary, size);
  std::size_t at = 0;
  bool is_discrete = false;
  for (std::size_t i = 0; i < count; ++i) {
    const Slot& to = table_->slot(references[i]);
    is_discrete |= to.is_discrete;
    auto* elements = static_cast<Binary*>(to.data);
    for (std::size_t k = 0; k < to.size; ++k, ++at) {
      if (sizes[at] == 0) {
        elements[k].clear();
      } else {
        elements[k].assign(values[at], values[at] + sizes[at]);
      }
    }
  }
  note_change(is_discrete);
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
    if (at + output.size > size) refuse_count(at + output.size, size);
    for (std::size_t k = 0; k < output.size; ++k) values[at++] = row.derivative[k];
  }
  if (at != size) refuse_count(at, size);
}

}  // namespace stride::kit
