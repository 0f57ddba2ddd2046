// The dependencies between the values of a system at one instant.
#ifndef STRIDE_MASTER_ENGINE_RUN_LOOPS_DEPENDENCIES_H
#define STRIDE_MASTER_ENGINE_RUN_LOOPS_DEPENDENCIES_H

#include <cstddef>
#include <map>
#include <vector>

#include "master/engine/model/system/system.h"

namespace stride::core {

/// What an output depends on is declared for either of these.
enum class Phase {
  Initialization,  ///< <InitialUnknown>, else <Output>; what is exact depends on nothing
  Events,          ///< <Output>, in units with Event Mode; the others keep their outputs
};

/// For each component's output the connected inputs that it depends on at the same instant, as
/// ModelStructure declares it (FMI 3.0, 2.4.8): where the unit declares nothing, all of them. What
/// belongs to a clock takes no part; a message takes an event iteration.
class Dependencies {
 public:
  Dependencies(const System& system, Phase phase);

  struct Inputs {
    bool declared = true;                ///< if not, the output depends on all_inputs()
    std::vector<std::size_t> variables;  ///< indices in UnitDescription::variables, sorted
  };
  /// Of any output, connected or not.
  Inputs inputs_of(VariableId output) const;

  /// The component's inputs that are connected and not clocked, sorted.
  const std::vector<std::size_t>& all_inputs(std::size_t component) const {
    return inputs_[component];
  }

 private:
  /// The declarations of one component's description, by value reference.
  struct Declared {
    std::map<ValueReference, std::size_t> variables;
    std::map<ValueReference, const Unknown*> outputs, initial_unknowns;
  };

  bool depends_on_nothing(const UnitDescription& unit, const Variable& output) const;
  static std::vector<std::size_t> parameters_among(const UnitDescription& unit,
                                                   const std::vector<std::size_t>& variables);
  const Unknown* unknown(const Declared& declared, const Variable& output) const;

  const System& system_;
  Phase phase_;
  std::map<const UnitDescription*, Declared> declared_;  // for look-up only
  std::vector<std::vector<std::size_t>> inputs_;         // by component
};

/// Whether a connection carries a value in this phase. A fixed parameter takes one at the
/// initialisation only. What belongs to a time-based clock has one
/// at the initialisation and then at the clock's ticks only; what belongs to a triggered clock is a
/// message.
bool carries_value(const System& system, const Connection& connection, Phase phase);

}  // namespace stride::core

#endif
