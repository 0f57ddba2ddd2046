// The coverpoints of one component.
#ifndef STRIDE_MASTER_SYSTEM_SCENARIO_COVERAGE_POINTS_H
#define STRIDE_MASTER_SYSTEM_SCENARIO_COVERAGE_POINTS_H

#include <string>
#include <vector>

#include "master/engine/model/description.h"
#include "master/engine/model/system/system.h"
#include "master/observe/coverage/definition.h"
#include "master/system/declaration/coverage_declaration.h"

namespace stride::scenario {

/// What can be covered of one component, by the names of its unit's variables. Which of them are
/// messages the system decides: connections of clocks may make some of outputs.
class CoveragePoints {
 public:
  /// The system must outlive it.
  CoveragePoints(const core::System& system, std::size_t component)
      : system_(system),
        component_(component),
        description_(*system.components()[component].description) {}

  /// A point for each signal or message that the declaration means; none is a cross. Throws
  /// core::Error (Input) as select_coverage() does.
  std::vector<coverage::PointDefinition> select(const PointDeclaration& declared,
                                                std::uint64_t at_least) const;
  /// Automatic ones. The names of inputs for which there can be none are added.
  std::vector<coverage::PointDefinition> automatic(std::uint64_t at_least,
                                                   std::vector<std::string>& without_range) const;

 private:
  struct Subject {
    std::size_t variable;
    std::size_t element;
    std::string name;
  };

  bool is_signal(std::size_t variable) const;
  bool is_reported(std::size_t variable) const;
  std::vector<Subject> find(const PointDeclaration& declared) const;
  [[noreturn]] void fail_unknown(const PointDeclaration& declared) const;
  coverage::PointDefinition point(const PointDeclaration& declared, const Subject& subject) const;
  void add_messages(const Subject& subject, std::uint64_t at_least,
                    std::vector<coverage::PointDefinition>& points) const;
  void add_values(const Subject& subject, std::uint64_t at_least,
                  std::vector<coverage::PointDefinition>& points,
                  std::vector<std::string>& without_range) const;

  const core::System& system_;
  std::size_t component_;
  const core::UnitDescription& description_;
};

}  // namespace stride::scenario

#endif
