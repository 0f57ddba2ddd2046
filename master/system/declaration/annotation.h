// What SSP has no word for: the annotation of the type org.stride.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_ANNOTATION_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_ANNOTATION_H

#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/base/xml/element.h"
#include "master/observe/recorders/results_folder.h"
#include "master/system/declaration/check_declaration.h"
#include "master/system/declaration/component_selection.h"
#include "master/system/declaration/coverage_declaration.h"
#include "master/system/declaration/interventions.h"
#include "master/system/declaration/run_settings.h"
#include "master/system/declaration/terminal_connections.h"

namespace stride::scenario {

/// A glob over "component.variable", and where it was written (an empty Location: nowhere).
struct SignalPattern {
  std::string text;
  core::Location where{};
};

/// Signals that are to share a diagram.
struct PlotPattern {
  std::string title;
  std::vector<SignalPattern> signals;
};

/// Whether components may do something; a later rule goes before an earlier one.
struct PermissionRule {
  ComponentPattern components;
  bool allowed = true;
};

/// All of it is optional.
struct ScenarioAnnotation {
  StepSettings step;
  std::optional<core::Location> step_where{};  ///< of that of the run
  std::vector<SignalPattern> record;           ///< none: every output
  std::vector<PlotPattern> plots;
  std::vector<CheckDeclaration> checks;
  std::vector<GroupDeclaration> coverage;
  std::vector<CoveredDeclaration> covered;  ///< checks of it
  recorders::ResultFiles results;
  std::vector<ComponentPattern> main_thread;  ///< stepped on the simulation's own thread only
  std::vector<PermissionRule> early_return;   ///< from steps; without one: allowed
  std::vector<PermissionRule> state_saving;   ///< by their own functions; without one: allowed
  /// To save the state before some steps only, and to repeat those in between; likewise.
  std::vector<PermissionRule> repeated_steps;
  HostRules hosts;
  IdleSettings idle;
  std::vector<InterventionDeclaration> interventions;
  std::vector<TerminalConnection> terminals;
};

/// Reads the <stride:Scenario> of a <ssd:SystemStructureDescription>, which is in the root's
/// annotations or in those of its system. Throws core::Error (Input) for what is unknown, doubled
/// or elsewhere.
ScenarioAnnotation read_annotation(const xml::Element& root);

}  // namespace stride::scenario

#endif
