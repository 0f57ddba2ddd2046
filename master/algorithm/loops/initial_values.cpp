#include "master/algorithm/loops/initial_values.h"

#include "master/algorithm/loops/ordered_evaluation.h"

namespace stride::core {
namespace {

class AllUnits : public OrderedEvaluation::Participants {
 public:
  bool takes_part(std::size_t) const override { return true; }
  void on_discontinuity(VariableId, bool) override {}
  bool include(std::size_t) override { return false; }
};

}  // namespace

void set_initial_values(RunContext& context, Time start) {
  AllUnits all;
  OrderedEvaluation(context, Phase::Initialization, &UnitStatistics::initialization_time)
      .run(start, all);
}

}  // namespace stride::core
