// The coverage of a run, collected while it goes on.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_COVERAGE_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_COVERAGE_H

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/engine/port/observer.h"
#include "master/engine/run/simulation.h"
#include "master/observe/coverage/definition.h"
#include "master/observe/coverage/message_point.h"
#include "master/observe/coverage/report.h"
#include "master/observe/coverage/signal_point.h"

namespace stride::coverage {

/// Counts what a component has been given: the values with which its steps begin, sampled at
/// communication points at which it is not suspended, and its messages. So the values of the last
/// communication point, with which no step begins, do not count.
///
/// Added to a simulation with signals(), which RunOptions::watched has to hold.
class Coverage final : public core::Observer {
 public:
  explicit Coverage(std::vector<GroupDefinition> definitions);
  Coverage(const Coverage&) = delete;
  Coverage& operator=(const Coverage&) = delete;

  bool is_empty() const { return groups_.empty(); }
  std::span<const GroupDefinition> definitions() const { return definitions_; }
  /// The variables whose values the points need.
  std::vector<core::VariableId> signals() const;
  /// The simulation that it is added to, which must outlive the run; without one no component is
  /// taken for suspended.
  void follow(const core::Simulation& simulation) { simulation_ = &simulation; }

  void on_start(std::span<const core::Signal> signals) override;
  bool wants_content() const override;
  void on_message(const core::Message& message) override;
  void on_communication_point(Time time) override;

  /// What was seen, at a communication point, behind on_start(). Reading throws core::BadState for
  /// the state of other definitions.
  void persist(core::StateArchive& state);

  /// At any time; also of a run that never began.
  Report report(std::string scenario) const;

 private:
  struct Group {
    std::size_t component = 0;
    std::vector<std::unique_ptr<Point>> points{};
    std::vector<SignalPoint*> signals{};
    std::vector<MessagePoint*> messages{};
    std::vector<CrossPoint*> value_crosses{}, message_crosses{};
    bool has_sample = false;
    Time sampled_at{};
  };

  static void add_point(Group& group, const PointDefinition& definition);
  static void commit(Group& group);
  bool is_suspended(std::size_t component) const;

  std::vector<GroupDefinition> definitions_;
  std::vector<Group> groups_;
  const core::Simulation* simulation_ = nullptr;
};

}  // namespace stride::coverage

#endif
