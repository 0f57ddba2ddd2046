#include "master/algorithm/loops/initial_values.h"

#include "master/algorithm/loops/ordered_evaluation.h"

namespace stride::core {
namespace {

class AllUnits : public OrderedEvaluation::Participants {
 public:
  bool takes_part(std::size_t) const override { return true; }
  void on_jump(VariableId, bool) override {}
  bool join(std::size_t) override { return false; }
};

}  // namespace

void set_initial_values(const System& system, std::span<const std::unique_ptr<Unit>> units,
                        Exchange& exchange, const UnitTimer& timer, Time start) {
  AllUnits all;
  OrderedEvaluation(system, units, exchange, Phase::Initialization, timer).run(start, all);
}

}  // namespace stride::core
