#include "master/observe/checkpoint/journals.h"

#include <string>
#include <utility>

#include "master/base/state_archive.h"
#include "master/observe/checkpoint/kept_state.h"

namespace stride::checkpoint {
namespace {

std::string state_name(const core::Component& component) { return "unit/" + component.name; }

}  // namespace

void Journals::wrap(std::vector<std::unique_ptr<core::Unit>>& units, Time stop) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    const core::Component& component = system_.components()[i];
    auto journaled = std::make_unique<JournaledUnit>(
        std::move(units[i]), *component.description,
        JournaledUnit::Options{.context = {.unit = component.name}, .stop = stop});
    units_.push_back(journaled.get());
    units[i] = std::move(journaled);
  }
}

void Journals::restore(const Checkpoint& checkpoint) {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    core::StateArchive state(state_of(checkpoint, state_name(system_.components()[i])));
    units_[i]->persist(state);
    state.end();
  }
}

void Journals::add_to(Checkpoint& checkpoint) {
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const core::Component& component = system_.components()[i];
    core::StateArchive state;
    units_[i]->persist(state);
    checkpoint.states[state_name(component)] = state.bytes();
    checkpoint.units[component.name] = to_text(units_[i]->kept());
  }
}

}  // namespace stride::checkpoint
