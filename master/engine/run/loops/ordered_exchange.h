// The exchange of single variables, in the order of their evaluation.
#ifndef STRIDE_MASTER_ENGINE_RUN_LOOPS_ORDERED_EXCHANGE_H
#define STRIDE_MASTER_ENGINE_RUN_LOOPS_ORDERED_EXCHANGE_H

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "master/engine/run/context/run_context.h"
#include "master/engine/run/context/unit_timer.h"
#include "master/engine/run/loops/evaluation_order.h"

namespace stride::core {

/// Groups and links are planned in the order in which they will be used; inputs that become known
/// between two groups of a component are written by one call. The values are kept in the blocks of
/// an Exchange, which therefore has nothing to route afterwards.
class OrderedExchange {
 private:
  /// Variables of one component and type, read or written by one call.
  struct Batch {
    struct Member {
      ValueSlice value;   ///< in the exchange
      std::size_t first;  ///< in `values`
    };
    std::vector<ValueReference> references;
    std::vector<Member> members;
    std::size_t size = 0;  ///< of `values`, which are made when they are needed first
    ValueBlock values;
    bool is_due = false;
    bool is_new = false;  ///< never written
  };

 public:
  /// The context must outlive this object. `all_new`: an input is written when it is first
  /// routed, whatever its value; otherwise only when it changes.
  OrderedExchange(RunContext& context, const UnitTimer& timer, bool all_new);

  class Link {
   public:
    ElementRange target() const { return connection_->target(); }
    const ValueSlice& target_value() const { return to_; }

   private:
    friend OrderedExchange;
    const Connection* connection_;
    ValueSlice from_, to_;
    Batch* batch_;
  };
  class OutputRead {
   public:
    std::size_t component() const { return component_; }

   private:
    friend OrderedExchange;
    std::size_t component_;
    std::vector<Batch> batches_;
  };

  OutputRead plan_read(const OutputGroup& group);
  /// The connection whose target it is.
  Link plan_link(const ElementRange& target);

  /// Discards pending writes.
  void begin();
  /// Writes what was routed to the component, then reads the outputs of the group.
  void evaluate(OutputRead& read);
  /// Writes what was routed to the component.
  void write_inputs(std::size_t component);
  /// Copies an output's value to the input; returns whether the input changes. All of an array is
  /// written, of which elements are connected one by one.
  bool route(Link& link);
  /// The input was changed in the exchange, see Link::target_value().
  void touch(Link& link) { make_due(link); }
  /// Reads the unit's current value of the input into the exchange.
  void read_input(Link& link);
  /// Whether an output of the group is NaN.
  bool has_nan(const OutputRead& read) const;

 private:
  static Batch make_batch(ValueType type, bool is_new) {
    return {{}, {}, 0, ValueBlock(type, 0), false, is_new};
  }
  static void complete(Batch& batch);
  void add(Batch& batch, VariableId id);
  void make_due(Link& link);

  const System& system_;
  std::span<const std::unique_ptr<Unit>> units_;
  Exchange& exchange_;
  UnitTimer timer_;
  bool all_new_;
  std::deque<Batch> batches_;                                  // of inputs
  std::map<std::tuple<std::size_t, ValueType>, Batch*> open_;  // of a component, while planning
  std::vector<std::vector<Batch*>> due_;                       // by component
};

}  // namespace stride::core

#endif
