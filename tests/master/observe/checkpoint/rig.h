// A journaled unit as it is in a run.
#ifndef STRIDE_TESTS_MASTER_OBSERVE_CHECKPOINT_RIG_H
#define STRIDE_TESTS_MASTER_OBSERVE_CHECKPOINT_RIG_H

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "master/engine/run/stepping/coasting_unit.h"
#include "master/observe/checkpoint/journaled_unit.h"
#include "tests/master/observe/checkpoint/driver.h"

namespace stride::tests {

/// Below a CoastingUnit where `coasts`, as Simulation makes it of a unit that saves its state. Not
/// for units whose getters change something, which it does not repeat.
class Rig {
 public:
  Rig(std::unique_ptr<core::Unit> unit, std::shared_ptr<const core::UnitDescription> description,
      bool coasts = true, std::optional<Time> stop = {})
      : description_(std::move(description)) {
    auto journaled_unit = std::make_unique<checkpoint::JournaledUnit>(
        std::move(unit), *description_,
        checkpoint::JournaledUnit::Options{
            .context = {.where = {"system.ssd", 7}, .unit = "part"},
            .stop = stop,
            .warn = [this](const std::string& text) { warnings->push_back(text); }});
    journaled = journaled_unit.get();
    unit_ = std::move(journaled_unit);
    if (!coasts || unit_->capability<core::StateSaving>() == nullptr) return;
    core::SaveInterval interval(5, false);
    unit_ = std::make_unique<core::CoastingUnit>(std::move(unit_), *description_, interval,
                                                 std::size_t{1} << 20);
  }

  core::Unit& operator*() { return *unit_; }
  core::Unit* operator->() { return unit_.get(); }

  std::vector<std::byte> write() {
    core::StateArchive state;
    journaled->persist(state);
    return state.bytes();
  }
  void read(std::span<const std::byte> bytes) {
    core::StateArchive state(bytes);
    journaled->persist(state);
    state.end();
  }

  checkpoint::JournaledUnit* journaled = nullptr;
  std::shared_ptr<std::vector<std::string>> warnings = std::make_shared<std::vector<std::string>>();

 private:
  std::shared_ptr<const core::UnitDescription> description_;
  std::unique_ptr<core::Unit> unit_;
};

}  // namespace stride::tests

#endif
