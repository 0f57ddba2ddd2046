// An instance of an FMI 1.0 unit for stand-alone Co-Simulation in this process.
#ifndef STRIDE_MASTER_LOADER_FMU_FMI1_FMI1_UNIT_H
#define STRIDE_MASTER_LOADER_FMU_FMI1_FMI1_UNIT_H

#include <memory>
#include <optional>
#include <string>

#include <stride/fmi1.h>

#include "master/engine/port/capabilities/resetting.h"
#include "master/loader/fmu/description/fmi1_attributes.h"
#include "master/loader/fmu/instance/scalar_unit.h"
#include "master/loader/fmu/library/fmi1_library.h"

namespace stride::importer {

/// The types and names of FMI 1.0.
struct Fmi1Version {
  using Functions = Fmi1Functions;
  static constexpr const char* kName = "FMI 1.0";
  STRIDE_SCALAR_VERSION(fmi1, "fmi")
};

/// See core::Unit for the order of calls, FmuInstance for failures, and ScalarUnit for values;
/// terminate() does nothing after a failure. Such a unit has neither Event Mode nor clocks, and its
/// state cannot be saved. It has no Initialization Mode either: it is initialized when that is
/// entered, and what is set afterwards is an input.
///
/// fmiDiscard means that the unit completed a part of the step: up to fmiLastSuccessfulTime, which
/// is accepted like an early return. A step of which nothing was completed is rejected, if the unit
/// canRejectSteps; the next one is repeated from the same point (newStep is false). fmiPending is
/// an error.
class Fmi1Unit final : public ScalarUnit<Fmi1Version>, public core::Capabilities<core::Resetting> {
 public:
  /// Throws core::Error of the kind Run, with the unit's messages, if it cannot be instantiated.
  Fmi1Unit(std::string name, std::shared_ptr<const Fmi1Library> library,
           std::shared_ptr<const Fmi1Attributes> attributes, UnitParts parts,
           InstanceOptions options = {});
  ~Fmi1Unit() override;

  void enter_initialization(Time start, std::optional<Time> stop) override;
  void exit_initialization() override {}
  void get(References references, core::ValueBlock& values) override;
  void set(References references, const core::ValueBlock& values) override;
  using FmuInstance::step;
  core::StepResult step(const core::StepInterval& interval,
                        const core::StepValues& values) override;
  void reset() override;
  void terminate() override;
  void free() override;

 private:
  core::Capability* find_capability(core::CapabilityId id) override;

  static void on_log(fmi1Component component, fmi1String instance, fmi1Status status,
                     fmi1String category, fmi1String message, ...);

  bool has_negated(References references) const;
  void negate(References references, core::ValueBlock& values) const;

  core::StepResult handle_discard(const core::StepInterval& interval);
  /// In seconds; nothing if it is not known.
  std::optional<double> last_successful_time();

  bool is_new_step_ = true;
  std::shared_ptr<const Fmi1Library> library_;
  std::shared_ptr<const Fmi1Attributes> attributes_;
};

}  // namespace stride::importer

#endif
