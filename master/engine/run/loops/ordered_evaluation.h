// Evaluates the outputs of a system at one instant in the order of their dependencies, and solves
// algebraic loops.
#ifndef STRIDE_MASTER_ENGINE_RUN_LOOPS_ORDERED_EVALUATION_H
#define STRIDE_MASTER_ENGINE_RUN_LOOPS_ORDERED_EVALUATION_H

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include <stride/time.h>

#include "master/engine/run/context/run_context.h"
#include "master/engine/run/context/unit_timer.h"
#include "master/engine/run/loops/algebraic_loop.h"
#include "master/engine/run/loops/evaluation_order.h"
#include "master/engine/run/loops/ordered_exchange.h"

namespace stride::core {

/// Applies evaluation_order() to the units of a run. Values go through the blocks of the Exchange,
/// so nothing remains to be routed afterwards.
class OrderedEvaluation {
 public:
  /// The components that take part. The outputs of another component keep their values, and its
  /// inputs are left to the Exchange.
  class Participants {
   public:
    virtual ~Participants() = default;
    virtual bool takes_part(std::size_t component) const = 0;
    /// In the phase Events: a continuous input of a component with Event Mode has changed.
    /// `is_followed`: an output of the component depends on it directly.
    virtual void on_discontinuity(VariableId input, bool is_followed) = 0;
    /// Makes the component take part, because a loop that it belongs to has to be solved. Returns
    /// whether it did not take part before.
    virtual bool include(std::size_t component) = 0;
  };

  /// The context must outlive this object. `time`: where the wall-clock time of the units'
  /// functions is added up.
  OrderedEvaluation(RunContext& context, Phase phase, UnitTimer::Sum time);
  OrderedEvaluation(const OrderedEvaluation&) = delete;
  OrderedEvaluation& operator=(const OrderedEvaluation&) = delete;

  /// Whether no output of a unit follows a connected input, so that run() is a mere exchange.
  bool is_trivial() const { return !has_direct_inputs_; }

  /// Reads and writes the values of the components that take part. At the initialisation, the
  /// search for the solution of a loop begins at the values of its inputs, and each connected input
  /// is written at least once. Throws Error (Run): a connected output is NaN, or no solution of a
  /// loop was found.
  void run(Time time, Participants& participants);

 private:
  struct GroupEvaluation {
    OrderedExchange::OutputRead read;
    std::vector<OrderedExchange::Link>
        links;  ///< of a loop: those that stay in it and are not torn
  };
  struct Block {
    std::vector<GroupEvaluation> groups;
    std::optional<AlgebraicLoop> loop;
    const EvaluationBlock* plan;
    std::vector<OrderedExchange::Link> onward;  ///< out of the loop
  };

  using Targets = std::map<VariableId, std::vector<ElementRange>>;  // of an output
  void plan(const EvaluationBlock& planned, const Targets& targets, RunContext& context);
  void find_direct_inputs();
  void evaluate(GroupEvaluation& group);
  void route(OrderedExchange::Link& link);
  void evaluate_loop(Block& block);
  void solve(Block& block);
  void sweep(Block& block);
  void check_nan(const Block& block) const;
  void report(VariableId input);
  bool takes_part(const Block& block) const;

  const System& system_;
  Exchange& exchange_;
  Phase phase_;
  std::vector<EvaluationBlock> order_;
  OrderedExchange ordered_exchange_;
  std::vector<Block> blocks_;
  std::set<VariableId> followed_;   ///< continuous inputs on which an output depends
  bool has_direct_inputs_ = false;  ///< of any kind

  Participants* participants_ = nullptr;
  Time time_{};
  bool is_trying_ = false;  ///< values are those of an iteration, not of a solution
};

/// The units are in Initialization Mode. Reads each connected output after all that it depends on,
/// and writes each connected input; algebraic loops are solved. So values pass through a chain of
/// units of any length before the first step, and a unit is called only as often as the declared
/// dependencies require. Throws Error (Run): a connected output is NaN, or no solution of a loop
/// was found.
void set_initial_values(RunContext& context, Time start);

}  // namespace stride::core

#endif
