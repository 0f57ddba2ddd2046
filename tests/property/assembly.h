// Systems of real FMUs, wired by a test and run with all that can be recorded.
#ifndef STRIDE_TESTS_PROPERTY_ASSEMBLY_H
#define STRIDE_TESTS_PROPERTY_ASSEMBLY_H

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/run/simulation.h"
#include "master/loader/fmu/fmu.h"
#include "master/observe/capture/capture.h"
#include "tests/build.h"

namespace stride::tests {

/// A unit made for tests, loaded once: of the kit's units the library itself, of the others
/// NAME.fmu.
std::shared_ptr<importer::Fmu> test_unit(const std::string& name);

class Assembly {
 public:
  using Values = std::vector<std::pair<std::string, std::string>>;

  Assembly& add(const std::string& name, const std::string& unit, const Values& start_values = {});
  Assembly& add(const std::string& name, std::shared_ptr<importer::Fmu> unit,
                const Values& start_values = {});
  /// "a.y", "b.u"
  Assembly& wire(const std::string& from, const std::string& to);
  /// The three connections of a numbered message: "ticker.tick", "listener.message".
  Assembly& wire_message(const std::string& from, const std::string& to);
  Assembly& set(const std::string& variable, const std::string& value);
  /// The same system, of which these components have processes of their own. With `snapshots`
  /// these replace states that units do not have.
  Assembly hosted(std::set<std::string> components, bool snapshots = false) const;
  /// Likewise, all of its components.
  Assembly hosted() const;
  /// The same system, whose components that have processes of their own run behind `stride serve`.
  Assembly served() const;
  /// The same system, of which some components with Event Mode have steps of their own.
  Assembly with_own_steps(unsigned seed) const;
  /// The same system, of which some components have steps of their own. Some of these must not
  /// return early, and some take steps of one size only.
  Assembly with_strict_own_steps(unsigned seed) const;
  /// The same system with its components and connections in another order.
  Assembly shuffled(unsigned seed) const;

  const core::SystemDeclaration& declaration() const { return declaration_; }
  std::vector<std::unique_ptr<core::Unit>> instantiate() const;
  /// For the messages of a test that fails.
  std::string text() const;

 private:
  Assembly with_any_own_steps(unsigned seed) const;

  core::SystemDeclaration declaration_;
  std::map<std::string, std::shared_ptr<importer::Fmu>> units_;  ///< by component
  std::set<std::string> hosted_;                                 ///< components
  bool is_served_ = false;                                       ///< these
};

struct Results {
  std::string signals;  ///< signals.csv with all outputs, sorted by component
  std::string events;   ///< events.csv
  core::RunStatistics statistics;
  std::map<std::string, core::UnitStatistics> units;
  std::map<Time, std::vector<double>> values;  ///< of all numeric outputs, by instant
  std::vector<std::string> names;              ///< of the values

  double value(Time time, const std::string& name) const;
  std::vector<std::string> event_rows() const;  ///< sorted, without the header
};

/// Signals and events.
void check_same_bytes(const Results& results, const Results& expected);

core::RunOptions fixed_steps(Duration step, Time stop);

/// Records all outputs, whatever the options say of it, and captures what these receive.
Results run(const Assembly& assembly, core::RunOptions options,
            const std::vector<capture::CaptureRequest>& captures = {});
/// Runs from 0 s to `stop` in fixed steps.
inline Results run(const Assembly& assembly, Duration step, Time stop,
                   const core::ThreadOptions& threads = {}) {
  core::RunOptions options = fixed_steps(step, stop);
  options.threads = threads;
  return run(assembly, options);
}

}  // namespace stride::tests

#endif
