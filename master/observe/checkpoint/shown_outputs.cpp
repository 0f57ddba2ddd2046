#include "master/observe/checkpoint/shown_outputs.h"

#include <cstddef>
#include <span>

#include "master/engine/model/values.h"
#include "master/observe/checkpoint/answer_check.h"

namespace stride::checkpoint {
namespace {

template <class Visit>
void for_each_output(const core::UnitDescription& description, Visit&& visit) {
  for (const core::Variable& variable : description.variables) {
    const bool is_output = variable.causality == core::Causality::Output;
    if (is_output && variable.is_unclocked_value()) visit(variable);
  }
}

}  // namespace

std::vector<std::uint64_t> shown_outputs(core::Unit& unit,
                                         const core::UnitDescription& description) {
  std::vector<std::uint64_t> hashes;
  for_each_output(description, [&](const core::Variable& variable) {
    core::ValueBlock values(variable.type, variable.size);
    unit.get({&variable.reference, 1}, values);
    AnswerCheck check;
    check.add(values);
    hashes.push_back(check.hash());
  });
  return hashes;
}

const core::Variable* first_difference(core::Unit& unit, const core::UnitDescription& description,
                                       const std::vector<std::uint64_t>& before) {
  const std::vector<std::uint64_t> now = shown_outputs(unit, description);
  const core::Variable* different = nullptr;
  std::size_t place = 0;
  for_each_output(description, [&](const core::Variable& variable) {
    const bool is_same = place < before.size() && before[place] == now[place];
    if (!is_same && different == nullptr) different = &variable;
    ++place;
  });
  return different;
}

}  // namespace stride::checkpoint
