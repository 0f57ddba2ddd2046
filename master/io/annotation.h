// What SSP has no word for: the annotation of the type org.stride.
#ifndef STRIDE_MASTER_IO_ANNOTATION_H
#define STRIDE_MASTER_IO_ANNOTATION_H

#include <array>
#include <string>
#include <utility>
#include <vector>

#include <stride/time.h>

#include "master/io/check_declaration.h"
#include "master/io/component_selection.h"
#include "master/io/host_choice.h"
#include "master/io/idle_choice.h"
#include "master/io/step_choice.h"
#include "master/util/error.h"
#include "master/util/xml/element.h"

namespace stride::io {

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

/// File names inside the results folder; empty = not written.
struct ResultFiles {
  std::string signals = "signals.csv";
  std::string events = "events.csv";
  std::string trace = "signals.vcd";
  std::string activity = "activity.csv";
  std::string statistics = "run.json";
  std::string report = "report.html";
};

/// Each of them, with the attribute that names it.
inline constexpr std::array<std::pair<const char*, std::string ResultFiles::*>, 6> kResultFiles{
    {{"signals", &ResultFiles::signals},
     {"events", &ResultFiles::events},
     {"trace", &ResultFiles::trace},
     {"activity", &ResultFiles::activity},
     {"statistics", &ResultFiles::statistics},
     {"report", &ResultFiles::report}}};

/// Whether components may return early from their steps; a later rule goes before an earlier one.
struct EarlyReturnRule {
  ComponentPattern components;
  bool allowed = true;
};

/// All of it is optional.
struct ScenarioAnnotation {
  StepChoice step;
  std::vector<SignalPattern> record;  ///< none: every output
  std::vector<PlotPattern> plots;
  std::vector<CheckDeclaration> checks;
  ResultFiles results;
  std::vector<ComponentPattern> main_thread;  ///< who steps on the simulation's own thread only
  std::vector<EarlyReturnRule> early_return;  ///< without one: allowed
  HostChoice hosts;
  IdleChoice idle;
};

/// Whether it names a file in the results folder itself.
bool is_plain_file_name(const std::string& name);

/// Reads the <stride:Scenario> of a <ssd:SystemStructureDescription>, which stands in the root's
/// annotations or in those of its system. Throws core::Error (Input) for what is unknown, doubled
/// or in another place.
ScenarioAnnotation read_annotation(const xml::Element& root);

}  // namespace stride::io

#endif
