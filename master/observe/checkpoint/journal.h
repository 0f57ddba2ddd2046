// The calls of a unit, in their order.
#ifndef STRIDE_MASTER_OBSERVE_CHECKPOINT_JOURNAL_H
#define STRIDE_MASTER_OBSERVE_CHECKPOINT_JOURNAL_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <stride/time.h>

#include "master/base/state_archive.h"
#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/unit.h"
#include "master/observe/checkpoint/answer_check.h"
#include "master/observe/checkpoint/byte_log.h"
#include "master/observe/checkpoint/record.h"
#include "master/observe/checkpoint/variable_lists.h"

namespace stride::checkpoint {

/// Notes calls and folds what the unit answers into a check, which is noted at the end of each step
/// and event iteration. Values that are those of the last call take a byte or two.
///
/// Replay makes a unit do it all again.
class Journal {
 public:
  /// What the journal is at an instant, beside its records.
  struct Context {
    Time time{};      ///< of the unit
    Duration step{};  ///< the last one's size
    std::uint64_t steps = 0;
    bool has_input_update = false;  ///< it may ask for its inputs within a step
    AnswerCheck answers;
  };
  struct Mark {
    ByteLog::Position position = 0;
    Context context;
  };

  Journal() = default;
  /// Goes on where another one ended.
  explicit Journal(const Context& context) : context_(context) {}

  Mark mark() const { return {log_.end(), context_}; }
  /// Forgets what is behind.
  void cut(const Mark& mark);
  /// Makes it possible to read from here on, without what is before.
  void begin_part();
  /// Forgets what is before. No earlier mark must be used any longer.
  void drop_before(const Mark& mark) { log_.drop_before(mark.position); }
  /// The earliest one that cut() can go back to.
  ByteLog::Position begin() const { return log_.begin(); }
  const Context& context() const { return context_; }
  /// [byte]
  std::size_t memory() const { return log_.memory(); }

  // ---- What the unit is called with ----

  void add(Call call);
  void add_initialization(Time start, std::optional<Time> stop);
  void add_set(std::span<const core::ValueReference> references, const core::ValueBlock& values);
  /// `values`: what it has answered; likewise below.
  void add_get(std::span<const core::ValueReference> references, const core::ValueBlock& values);
  /// Behind it add_input_request(), add_set() and add_get() for what happens within the step, and
  /// add_step_end().
  void add_step(const core::StepInterval& interval, const core::StepValues& values);
  void add_input_request(double seconds_into_step);
  void add_step_end(const core::StepResult& result, std::span<const core::BoundValues> outputs);
  void add_event(const core::EventResult& result);
  void add_idle_skipping(Duration max_skip);
  void add_idle_tolerances(std::span<const core::ValueReference> outputs,
                           std::span<const double> tolerances);
  void add_clock_interval(core::ValueReference clock, const core::ClockInterval& answer);
  void add_clock_shift(core::ValueReference clock, const core::Interval& answer);
  void add_input_update(bool is_set);

  /// Writes what follows the mark; reads it, to begin there. Throws core::BadState.
  void persist(core::StateArchive& state, const core::UnitDescription& description,
               ByteLog::Position from);
  static void persist(core::StateArchive& state, Context& context);

 private:
  friend class Replay;

  RecordWriter record(Call call) { return {log_, call}; }
  void put_values(RecordWriter& record, std::span<const core::ValueReference> references,
                  const core::ValueBlock& values);

  ByteLog log_;
  VariableLists lists_;
  Context context_;
  Time step_end_{};  ///< of the step that was added last
};

/// As they are folded into a check.
void add(AnswerCheck& check, const core::EventResult& result);
void add(AnswerCheck& check, const core::ClockInterval& answer);
void add(AnswerCheck& check, const core::Interval& answer);

}  // namespace stride::checkpoint

#endif
