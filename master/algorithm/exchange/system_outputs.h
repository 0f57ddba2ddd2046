// The values that leave a system under names of its own.
#ifndef STRIDE_MASTER_ALGORITHM_EXCHANGE_SYSTEM_OUTPUTS_H
#define STRIDE_MASTER_ALGORITHM_EXCHANGE_SYSTEM_OUTPUTS_H

#include <span>
#include <vector>

#include "master/algorithm/exchange/exchange.h"
#include "master/model/system.h"

namespace stride::core {

/// Those of System::outputs() that are observed. They have places of their own, since they are
/// converted on their way out.
class SystemOutputs {
 public:
  SystemOutputs(const System& system, std::span<const VariableId> observed);

  /// What an Exchange has to read for all that is observed.
  const std::vector<VariableId>& sources() const { return sources_; }
  /// Where the values come from; the exchange must outlive this object.
  void connect(Exchange& exchange);
  /// Takes what stands in the exchange.
  void update();
  /// Of an observed variable, whether it is an output of the system or not.
  Signal signal(VariableId id, Exchange& exchange) const;

 private:
  struct Output {
    VariableId id;
    const SystemOutput* output;
    ValueBlock block;
    Signal source{};
  };

  const System& system_;
  std::vector<VariableId> sources_;
  std::vector<Output> outputs_;  ///< pointers into it stay valid
};

}  // namespace stride::core

#endif
