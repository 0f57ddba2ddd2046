#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/study/verify/checks.h"
#include "master/study/verify/checks/damaged_states.h"
#include "master/study/verify/checks/serialized_run.h"
#include "master/study/verify/disturbance.h"

namespace stride::verify {
namespace {

enum class Receiver { New, Initialized };

/// An instance that was never started, or was initialized with the same start values, with the
/// state.
TestInstance restored(const Trial& trial, const SerializedState& state, Receiver receiver) {
  TestInstance instance = trial.make_instance();
  if (receiver == Receiver::Initialized) instance.start();
  restore(trial, instance, state);
  return instance;
}

/// What is checked of one unit, and the notes on it.
class SerializationCheck {
 public:
  explicit SerializationCheck(const Trial& trial) : trial_(trial), is_of_kit_(trial.is_of_kit()) {}

  Finding run() {
    const std::vector<Cut> cuts = cuts_of_unit();
    run_ = serialized_run_from_text(
        trial_.in_child([&] { return to_text(run_with_cuts(trial_, cuts)); }));
    if (run_.states.empty()) return skipped("it ends the simulation before 30 % of the run");
    require_undisturbed();
    continue_in_same_process();
    for (const SerializedState& state : run_.states) continue_in_other_processes(state);
    require_stable();
    examine_damaged();
    return passed(summary(), std::move(notes_));
  }

 private:
  std::vector<Cut> cuts_of_unit() const {
    const SerializedRun chosen = serialized_run_from_text(trial_.in_child([&] {
      SerializedRun run;
      for (const Cut& cut : choose_cuts(trial_)) run.states.push_back({cut, {}, {}, 0});
      return to_text(run);
    }));
    std::vector<Cut> cuts;
    for (const SerializedState& state : chosen.states) cuts.push_back(state.cut);
    return cuts;
  }

  /// Another run, whose states nobody has saved, is the same.
  void require_undisturbed() {
    compare(trial_.record({}, run_.to).rows, run_.rows, "in a run of which no state is serialised",
            "in one of which some are");
  }

  void continue_in_same_process() {
    if (trial_.tested.description().single_instance) return;
    const Cut& cut = run_.states.front().cut;
    go_on_in_new([&](Receiver receiver) {
      return trial_.in_child([&] {
        const SerializedRun again = run_with_cuts(trial_, {cut});
        return difference_after(again, again.states.front(), receiver,
                                "in another one of the same process");
      });
    });
  }

  void continue_in_other_processes(const SerializedState& state) {
    const std::string place = state.cut.place.empty() ? "" : ", serialised " + state.cut.place;
    const auto go_on = [&](Receiver receiver) {
      const std::string initialised = receiver == Receiver::New ? "" : "initialised ";
      return trial_.in_child([&] {
        return difference_after(run_, state, receiver,
                                "in an " + initialised + "instance of another process" + place);
      });
    };
    go_on_in_new(go_on);
    note(go_on(Receiver::Initialized));
  }

  template <class GoOn>
  void go_on_in_new(const GoOn& go_on) {
    try {
      note(go_on(Receiver::New));
    } catch (const Failure& failure) {
      if (!goes_on_if_initialized(go_on)) throw;
      throw Failure(
          fmt::format("{}; this is in an instance that was never initialised, another "
                      "one goes on well",
                      failure.what()));
    }
  }

  /// Many units need an initialized instance, though the standards allow the calls in a new one,
  /// too (FMI 2.0, 4.2.4; FMI 3.0, 2.3.1).
  template <class GoOn>
  static bool goes_on_if_initialized(const GoOn& go_on) {
    try {
      go_on(Receiver::Initialized);
      return true;
    } catch (const Failure&) {
      return false;
    }
  }

  /// Throws Failure where what follows in such an instance is not what follows in the run. Returns
  /// how it differs by rounding.
  std::string difference_after(const SerializedRun& run, const SerializedState& state,
                               Receiver receiver, const std::string& where) const {
    TestInstance instance = restored(trial_, state, receiver);
    finish_from(instance, state, run.to);
    std::string rounding;
    const auto differs =
        difference_beyond_rounding(trial_.tested, run.rows_after(state), instance.recording().rows,
                                   "in the instance that was serialised", where, rounding);
    if (differs) throw Failure(*differs);
    return rounding;
  }

  void compare(const std::vector<Row>& expected, const std::vector<Row>& seen,
               const std::string& expected_when, const std::string& seen_when) {
    std::string rounding;
    const auto differs = difference_beyond_rounding(trial_.tested, expected, seen, expected_when,
                                                    seen_when, rounding);
    if (differs) throw Failure(*differs);
    note(rounding);
  }

  /// The first rounding that is seen.
  void note(const std::string& rounding) {
    if (notes_.empty() && !rounding.empty()) notes_.push_back(rounding);
  }

  /// The same state is the same bytes, whatever the memory was before, and wherever it is; also
  /// where it was restored.
  void require_stable() {
    const SerializedState& state = run_.states.front();
    const auto bytes_are_same = [&](auto&& make) {
      return trial_.in_child([&] {
        disturb();
        TestInstance instance = make();
        instance.template capability<core::StateSaving>().save_state();
        auto& serialization = instance.template capability<core::StateSerialization>();
        return std::string(serialization.serialize_state() == state.bytes ? "yes" : "no");
      }) == "yes";
    };
    if (!bytes_are_same([&] { return instance_at(trial_, state.cut); })) {
      complain(
          "the same state is other bytes in another process, so it has an address or memory "
          "without a value in it");
    } else if (is_of_kit_ &&
               !bytes_are_same([&] { return restored(trial_, state, Receiver::New); })) {
      complain("a state that was restored is serialised to other bytes");
    }
  }

  /// What the standards do not forbid, and the kit does.
  void complain(const std::string& what) {
    if (is_of_kit_) throw Failure(what, false);
    notes_.push_back(what);
  }

  void examine_damaged() {
    const auto damaged = damaged_states(run_.states.front().bytes);
    const std::vector<std::string> accepted = accepted_states(trial_, damaged);
    refuses_all_ = accepted.empty();
    for (const std::string& what : accepted) complain(what);
    if (is_of_kit_) require_refusals(trial_, run_, damaged);
  }

  std::string summary() const {
    return fmt::format(
        "a state of {} goes on in a new instance of {} process{}{}",
        core::counted(run_.states.front().bytes.size(), "byte"),
        trial_.tested.description().single_instance ? "another" : "this and of another",
        run_.states.size() > 1 ? fmt::format(", also from {} around events",
                                             core::counted(run_.states.size() - 1, "instant"))
                               : "",
        refuses_all_ ? "; damaged bytes are refused" : "");
  }

  const Trial& trial_;
  bool is_of_kit_;
  SerializedRun run_;
  bool refuses_all_ = true;
  std::vector<std::string> notes_;
};

}  // namespace

Finding check_serialization(const Trial& trial) {
  if (!trial.tested.description().can_serialize_state) {
    return skipped("it has no canSerializeFMUState");
  }
  return SerializationCheck(trial).run();
}

}  // namespace stride::verify
