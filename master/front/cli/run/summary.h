#ifndef STRIDE_MASTER_FRONT_CLI_RUN_SUMMARY_H
#define STRIDE_MASTER_FRONT_CLI_RUN_SUMMARY_H

#include <span>
#include <string>
#include <vector>

#include "master/base/state_archive.h"
#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"
#include "master/engine/run/context/statistics.h"

namespace stride::cli {

/// The summary of a run: its messages in order, the ranges of the first recorded scalars, and the
/// activity and cost of each unit.
class Summary : public core::Observer {
 public:
  /// A number, or a Boolean as 0 or 1, where the run keeps it.
  struct Value {
    const void* place = nullptr;
    double (*of)(const void*) = nullptr;
    double read() const { return of(place); }
  };

  Summary(const core::System& system, std::span<const core::VariableId> recorded);

  /// The scalars, to be requested of the simulation.
  const std::vector<core::VariableId>& signals() const { return signals_; }

  void on_start(std::span<const core::Signal> signals) override;
  bool wants_content() const override;
  void on_message(const core::Message& message) override;
  void on_communication_point(Time time) override;
  /// Of a run that is resumed, behind on_start(): what persist() does not know begins here.
  void begin_late(Time time);
  /// At a communication point, behind on_start(). Reads the ranges of those signals that are there.
  void persist(core::StateArchive& state);

  std::string text(const core::RunStatistics& statistics) const;

 private:
  struct Range {
    core::VariableId id;
    Value value;
    double least, most;
    bool is_whole = true;  ///< else since `since_`
  };
  struct Sent {
    core::VariableId id;
    Time time;
    std::string text;  ///< its content
    std::vector<std::size_t> receivers;
  };

  void note_receiver(core::VariableId receiver);
  std::string message_table() const;
  void persist_ranges(core::StateArchive& state);
  std::string signal_table() const;
  std::string idle_line(const core::RunStatistics& statistics) const;
  std::string host_line(const core::RunStatistics& statistics) const;
  std::string unit_table(const core::RunStatistics& statistics) const;

  const core::System& system_;
  std::vector<core::VariableId> signals_;
  std::size_t other_signals_ = 0;     ///< recorded numbers without a range
  std::size_t arrays_and_texts_ = 0;  ///< recorded, likewise
  std::vector<Range> ranges_;
  Time since_{};
  std::vector<Sent> messages_;
  std::size_t message_count_ = 0;
};

}  // namespace stride::cli

#endif
