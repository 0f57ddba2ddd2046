// The state of a journaled unit: written, and read in another process.
#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "master/observe/checkpoint/journaled_unit.h"
#include "master/observe/checkpoint/replay.h"
#include "master/observe/checkpoint/shown_outputs.h"

namespace stride::checkpoint {
namespace {

/// Of the unit's states. Slot 0 is the caller's.
constexpr std::size_t kOwnSlot = 1;

std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
}

/// What a unit logs meanwhile has been logged before.
class Repeating {
 public:
  explicit Repeating(core::UnitDiagnostics* diagnostics) : diagnostics_(diagnostics) { set(true); }
  ~Repeating() { set(false); }
  Repeating(const Repeating&) = delete;
  Repeating& operator=(const Repeating&) = delete;

 private:
  void set(bool is_repeating) {
    if (diagnostics_ != nullptr) diagnostics_->set_repeating(is_repeating);
  }

  core::UnitDiagnostics* diagnostics_;
};

}  // namespace

void JournaledUnit::persist(core::StateArchive& state) {
  state.mark("unit");
  if (state.is_reading()) return read(state);
  write(state);
}

// ---- States of the unit's own ----

template <class Action>
auto JournaledUnit::in_own_slot(Action&& action) {
  state_->select_state(kOwnSlot);
  try {
    auto result = action();
    state_->select_state(0);
    return result;
  } catch (...) {
    state_->select_state(0);
    throw;
  }
}

JournaledUnit::SerializedState JournaledUnit::serialize() {
  std::vector<std::uint8_t> bytes = in_own_slot([&] {
    state_->save_state();
    return serialization_->serialize_state();
  });
  return {journal_.mark(), std::move(bytes), shown_outputs(inner(), description_)};
}

/// Behind a failure: a unit that cannot has no other one to tell.
bool JournaledUnit::can_go_on() {
  try {
    shown_outputs(inner(), description_);
    return true;
  } catch (const core::Error&) {
    return false;
  }
}

void JournaledUnit::try_serialization() {
  try {
    SerializedState state = serialize();
    in_own_slot([&] { return serialization_->deserialize_state(state.bytes), true; });
    initialization_ = std::exchange(journal_, Journal(journal_.context()));
    state.mark = journal_.mark();
    states_.push_back(std::move(state));
  } catch (const std::exception& failure) {
    if (!can_go_on()) throw;
    if (!options_.warn) return;
    options_.warn(
        fmt::format("its state cannot be serialised, though it declares that it can "
                    "(canSerializeFMUState); all that it receives is kept, and repeated where the "
                    "run is resumed: {}",
                    failure.what()));
  }
}

/// Where it fails, the earlier ones do.
void JournaledUnit::add_state() {
  try {
    states_.push_back(serialize());
  } catch (const core::Error&) {
    if (!can_go_on()) throw;
    return;
  }
  journal_.begin_part();
  drop_needless_states();
}

/// Those that no restored state goes back to.
void JournaledUnit::drop_needless_states() {
  if (states_.size() < 2) return;
  const auto is_needed = [&](const SerializedState& next) {
    return saved_ && next.mark.position > saved_->position;
  };
  while (states_.size() > 1 && !is_needed(states_[1])) states_.erase(states_.begin());
  journal_.drop_before(states_.front().mark);
}

// ---- Writing ----

void JournaledUnit::write(core::StateArchive& state) {
  if (!is_initialized_ || is_in_step_) {
    core::fail_run(context(), "its state cannot be written now: it is not in Step Mode");
  }
  if (!states_.empty()) add_state();
  core::StateArchive content;
  persist_content(content);
  const auto* const first = reinterpret_cast<const std::uint8_t*>(content.bytes().data());
  std::vector<std::uint8_t> bytes(first, first + content.bytes().size());
  std::uint32_t sum = checksum(bytes);
  state.value(sum);
  state.values(bytes);
  note_kept(bytes.size());
}

void JournaledUnit::persist_content(core::StateArchive& state) {
  state.value(start_);
  bool is_serialized = !states_.empty();
  state.value(is_serialized);
  if (is_serialized) persist_serialized(state);
  const auto from = is_serialized ? states_.back().mark.position : journal_.begin();
  journal_.persist(state, description_, from);
}

void JournaledUnit::persist_serialized(core::StateArchive& state) {
  initialization_.persist(state, description_, initialization_.begin());
  if (state.is_reading()) states_.resize(1);
  Journal::persist(state, states_.back().mark.context);
  state.values(states_.back().bytes);
  state.values(states_.back().outputs);
}

void JournaledUnit::note_kept(std::size_t bytes) {
  kept_ = {.repeated_steps = journal_.context().steps, .bytes = bytes};
  if (states_.empty()) {
    kept_.since = start_;
    return;
  }
  const Journal::Context& at = states_.back().mark.context;
  kept_.serialized_bytes = states_.back().bytes.size();
  kept_.since = at.time;
  kept_.repeated_steps -= at.steps;
}

// ---- Reading ----

void JournaledUnit::read(core::StateArchive& state) {
  if (is_initialized_) throw std::logic_error("a unit was called before its state was read");
  std::uint32_t sum = 0;
  state.value(sum);
  std::vector<std::uint8_t> bytes;
  state.values(bytes);
  if (sum != checksum(bytes)) state.fail("its checksum is another one");
  core::StateArchive content(std::as_bytes(std::span(bytes)));
  persist_content(content);
  content.end();
  if (!states_.empty()) states_.back().mark.position = journal_.begin();
  rebuild();
  note_kept(bytes.size());
}

void JournaledUnit::rebuild() {
  const Repeating repeating(diagnostics_);
  Journal::Context from;
  if (!states_.empty()) {
    if (serialization_ == nullptr || state_ == nullptr) {
      throw core::BadState("the unit does not serialise its state, and did when it was written");
    }
    replay(initialization_, {});
    restore_serialized();
    from = states_.back().mark.context;
  }
  replay(journal_, from);
  if (inputs_within_step_ != nullptr) set_input_update(std::move(input_update_));
  is_initialized_ = true;
}

void JournaledUnit::replay(Journal& journal, const Journal::Context& from) {
  const Replay::Options options{options_.context, options_.stop};
  Replay replay(inner(), description_, journal, options);
  replay.run(from);
}

void JournaledUnit::restore_serialized() {
  const SerializedState& serialized = states_.back();
  try {
    in_own_slot([&] {
      serialization_->deserialize_state(serialized.bytes);
      state_->restore_state();
      return true;
    });
  } catch (const core::Error& error) {
    core::Context at = error.context();
    at.time = serialized.mark.context.time;
    throw core::Error(error.kind(), at,
                      "its state, as it was serialised, failed: " + error.message(), error.hint());
  }
  require_outputs(serialized);
}

void JournaledUnit::require_outputs(const SerializedState& serialized) {
  const core::Variable* const different =
      first_difference(inner(), description_, serialized.outputs);
  if (different == nullptr) return;
  core::Context at = options_.context;
  at.time = serialized.mark.context.time;
  at.variable = different->name;
  core::fail_run(at,
                 "its state was restored, and this output is not what it was when the state was "
                 "serialised: the state is not complete, or was not restored",
                 "'stride verify --check serialization' shows it without a run");
}

}  // namespace stride::checkpoint
