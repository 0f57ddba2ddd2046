// The states of a unit that are kept.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_SAVED_STATES_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_SAVED_STATES_H

#include <cstddef>
#include <deque>

namespace stride::importer {

/// One for each slot, of which one is chosen: the first, until another is.
template <class State>
class SavedStates {
 public:
  SavedStates() = default;
  SavedStates(const SavedStates&) = delete;
  SavedStates& operator=(const SavedStates&) = delete;

  void choose(std::size_t slot) {
    if (slot >= slots_.size()) slots_.resize(slot + 1);
    chosen_ = &slots_[slot];
  }
  State& chosen() { return *chosen_; }

  auto begin() { return slots_.begin(); }
  auto end() { return slots_.end(); }

 private:
  std::deque<State> slots_{1};  // whose elements stay where they are
  State* chosen_ = &slots_.front();
};

}  // namespace stride::importer

#endif
