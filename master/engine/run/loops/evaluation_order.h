// The order in which the values of a system are evaluated at one instant.
#ifndef STRIDE_MASTER_ENGINE_RUN_LOOPS_EVALUATION_ORDER_H
#define STRIDE_MASTER_ENGINE_RUN_LOOPS_EVALUATION_ORDER_H

#include <cstddef>
#include <string>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/run/loops/dependencies.h"

namespace stride::core {

/// Outputs of one component that are read together, since what they depend on is known.
struct OutputGroup {
  std::size_t component = 0;
  std::vector<VariableId> outputs;  ///< sorted
};

/// Where a loop is torn: these inputs, or elements of them, get the same value from one output, and
/// it is solved for.
struct TearingVariable {
  ElementRange source;
  Conversion conversion;
  std::vector<ElementRange> inputs;  ///< sorted; the target of one connection each
};

/// What is evaluated at once: outputs of one component, or an algebraic loop.
struct EvaluationBlock {
  /// One; of a loop, in the order in which they follow from `tearing_variables`.
  std::vector<OutputGroup> groups;
  std::vector<TearingVariable> tearing_variables;  ///< of a loop only, as what follows
  std::vector<VariableId> inputs;                  ///< all that the loop runs through, sorted
  std::vector<std::string> paths;                  ///< "a.u -> a.y -> b.u -> b.y -> a.u"
  std::size_t unnamed_paths = 0;  ///< those that `paths` leaves out, where there are many
  /// Components that declare no dependencies, if there would be no loop without them.
  std::vector<std::size_t> undeclared;

  bool is_loop() const { return !tearing_variables.empty(); }
};

/// All connected outputs that are not clocked, each behind those that it depends on. Components
/// are read in few groups: a component all of whose outputs can be read goes first; of several, the
/// first in the file. A loop is a strongly connected part of the dependencies, torn at few
/// connections. Both choices are heuristics, and depend on nothing but the system.
std::vector<EvaluationBlock> evaluation_order(const System& system, Phase phase);

/// The paths of a loop, in one line of text.
std::string path_text(const EvaluationBlock& loop);

/// "unit 'a' declares no dependencies", of a loop that would not be there otherwise; else empty.
std::string undeclared_text(const System& system, const EvaluationBlock& loop);

}  // namespace stride::core

#endif
