#include "master/engine/port/forwarding_unit.h"

#include <memory>
#include <stdexcept>

#include "tests/master/engine/run/forwarding.h"

using namespace stride;
using namespace stride::tests;

namespace {

class Forwarding final : public core::ForwardingUnit {
 public:
  explicit Forwarding(std::unique_ptr<core::Unit> unit) : ForwardingUnit(std::move(unit)) {}
};

/// Counts the states that are saved, of any unit.
class Counting final : public core::ForwardingUnit, public core::StateSaving {
 public:
  explicit Counting(std::unique_ptr<core::Unit> unit)
      : ForwardingUnit(std::move(unit)), state_(inner().capability<core::StateSaving>()) {}

  void save_state() override {
    ++saves;
    state_->save_state();
  }
  void restore_state() override { state_->restore_state(); }
  void select_state(std::size_t slot) override { state_->select_state(slot); }

  int saves = 0;

 private:
  core::Capability* find_capability(core::CapabilityId id) override {
    return find_decorated<core::StateSaving>(*this, id);
  }

  core::StateSaving* state_;
};

}  // namespace

TEST_CASE("a forwarding unit forwards all functions") {
  CompleteUnit::Calls calls;
  Forwarding unit(std::make_unique<CompleteUnit>(calls));
  check_functions(unit, calls);
}

TEST_CASE("a forwarding unit has all capabilities of its unit, as they are") {
  CompleteUnit::Calls calls;
  auto complete = std::make_unique<CompleteUnit>(calls);
  CompleteUnit& inner = *complete;
  Forwarding unit(std::move(complete));
  check_capabilities(unit);
  for (std::size_t i = 0; i < core::kCapabilities; ++i) {
    const auto id = static_cast<core::CapabilityId>(i);
    CHECK(unit.capability(id) == inner.capability(id));
  }
  CHECK(texts(unit).describe_message(0, {}) == "a message");
  CHECK(host_diagnostics(unit).host_statistics().snapshots == 3);
  CHECK(calls == CompleteUnit::Calls{"describe_message", "host_statistics"});
}

TEST_CASE("a decorator sees the calls of the capability that it implements, and no others") {
  CompleteUnit::Calls calls;
  Counting unit(std::make_unique<CompleteUnit>(calls));
  check_capabilities(unit);
  check_state_saving(unit, calls);
  CHECK(unit.saves == 1);
  check_idle_promises(unit, calls);
}

TEST_CASE("a decorator has no capability that its unit lacks") {
  Counting unit(std::make_unique<PlainUnit>());
  CHECK(capability_numbers(unit).empty());
  CHECK(unit.capability<core::StateSaving>() == nullptr);
  CHECK_THROWS_AS(unit.require_capability<core::StateSaving>(), std::logic_error);
}

TEST_CASE(
    "the capabilities of several units are in their order, with nothing where there is none") {
  CompleteUnit::Calls calls;
  std::vector<std::unique_ptr<core::Unit>> units;
  units.push_back(std::make_unique<PlainUnit>());
  units.push_back(std::make_unique<CompleteUnit>(calls));
  const auto found = core::capabilities<core::MessageText>(units);
  CHECK(found == std::vector<core::MessageText*>{nullptr, &texts(*units[1])});
}
