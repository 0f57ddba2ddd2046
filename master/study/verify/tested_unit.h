// What is verified, and how.
#ifndef STRIDE_MASTER_STUDY_VERIFY_TESTED_UNIT_H
#define STRIDE_MASTER_STUDY_VERIFY_TESTED_UNIT_H

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/engine/model/system/system.h"
#include "master/engine/model/time/grid.h"
#include "master/loader/fmu/fmu.h"

namespace stride::verify {

/// What the user asks for.
struct VerifyRequest {
  std::filesystem::path file{};      ///< a .fmu or its unpacked folder
  std::filesystem::path shown_as{};  ///< the file in messages, if that is another one
  std::vector<std::string>
      settings{};                     ///< "variable=value"; an input that is set is not stimulated
  std::vector<std::string> checks{};  ///< only these; empty = all
  std::optional<Duration> step{};     ///< nothing = the unit's own, or 1 ms
  std::optional<Duration> stop{};     ///< nothing = the unit's own, within reason
  std::uint64_t seed = 1;             ///< of the stimulus
  unsigned instances = 1000;          ///< of the check of memory
  double leak = 0;                    ///< of heap that an instance may leave behind [byte]
  std::chrono::milliseconds limit{60'000};  ///< for each check
};

/// A unit with the choices that the checks share. Its library is not loaded by this.
class TestedUnit {
 public:
  /// Variables of one type that are read by one call.
  struct Group {
    core::ValueType type;
    std::size_t size = 0;  ///< the number of elements
    std::vector<core::ValueReference> references;
    std::vector<std::size_t> places;  ///< in description().variables
  };

  /// Throws core::Error (Input) for what cannot be verified as asked.
  explicit TestedUnit(VerifyRequest request);

  const VerifyRequest& request() const { return request_; }
  importer::Fmu& fmu() const { return *fmu_; }
  /// With the array sizes that the user has set by structural parameters.
  const core::UnitDescription& description() const { return *system_->components()[0].description; }
  /// One component, the unit, with the values that the user has set.
  const core::System& system() const { return *system_; }
  bool is_set(std::size_t variable) const;

  /// The grid of communication points: k * step() for k = 0 … steps().
  Duration step() const { return grid_.step().rounded(); }
  std::size_t steps() const { return steps_; }
  Time start() const { return grid_.start(); }
  Time point(std::size_t k) const { return grid_.point(k); }

  /// What can be read at each communication point and shows the state of the unit: outputs, locals
  /// and calculated parameters that have no clock.
  const std::vector<Group>& observed() const { return observed_; }
  std::size_t observed_count() const { return observed_count_; }

  /// "fmi3DoStep", from "DoStep"; for an FMI 2.0 unit "fmi2DoStep".
  std::string function(const std::string& name) const;
  /// Likewise as the library exports it.
  std::string symbol(const std::string& name) const;

 private:
  core::Interval chosen_step() const;
  void choose_times();
  void choose_observed();

  VerifyRequest request_;
  std::shared_ptr<importer::Fmu> fmu_;
  std::optional<core::System> system_;
  core::Grid grid_{Time{}, Duration(1)};
  std::size_t steps_ = 0;
  std::vector<Group> observed_;
  std::size_t observed_count_ = 0;
};

}  // namespace stride::verify

#endif
