// The outputs of a system, under its own names.
#ifndef STRIDE_MASTER_ENGINE_RUN_EXCHANGE_SYSTEM_OUTPUTS_H
#define STRIDE_MASTER_ENGINE_RUN_EXCHANGE_SYSTEM_OUTPUTS_H

#include <map>
#include <span>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/run/exchange/exchange.h"

namespace stride::core {

/// The System::outputs() that are observed. Those with a source have blocks of their own, since
/// they are converted.
class SystemOutputs {
 public:
  SystemOutputs(const System& system, std::span<const VariableId> observed);

  /// The variables that an Exchange has to read for all observed ones.
  const std::vector<VariableId>& sources() const { return sources_; }
  /// Connects the outputs with their sources. The exchange must outlive this object.
  void connect(Exchange& exchange);
  /// Copies the values from the exchange. Throws Error (Run) for a value that becomes none of the
  /// items of the output's Enumeration.
  void update(Time time) {
    if (!outputs_.empty()) update_all(time);
  }
  /// The signal of an observed variable, which may be an output of the system or another variable.
  Signal signal(VariableId id, Exchange& exchange) const;

 private:
  void update_all(Time time);

  struct Output {
    VariableId id;
    const SystemOutput* output;
    ValueBlock block;
    Signal source{};
  };

  const System& system_;
  const FirstValues* first_values_ = nullptr;
  std::vector<VariableId> sources_;
  std::vector<Output> outputs_;  ///< pointers into it stay valid
  std::map<VariableId, ValueBlock> constants_;
};

}  // namespace stride::core

#endif
