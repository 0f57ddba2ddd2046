// The coverpoints of one component.
#ifndef STRIDE_MASTER_SCENARIO_COVERAGE_POINTS_H
#define STRIDE_MASTER_SCENARIO_COVERAGE_POINTS_H

#include <string>
#include <vector>

#include "master/coverage/definition.h"
#include "master/model/description.h"
#include "master/scenario/coverage_declaration.h"

namespace stride::scenario {

/// What can be covered of one component, by the names of its unit's variables.
class CoveragePoints {
 public:
  /// The description must outlive it.
  CoveragePoints(std::size_t component, const core::UnitDescription& description)
      : component_(component), description_(description) {}

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

  bool is_signal(const core::Variable& variable) const;
  bool is_message(const core::Variable& variable) const;
  std::vector<Subject> find(const PointDeclaration& declared) const;
  [[noreturn]] void fail_unknown(const PointDeclaration& declared) const;
  coverage::PointDefinition point(const PointDeclaration& declared, const Subject& subject) const;
  void add_messages(const Subject& subject, std::uint64_t at_least,
                    std::vector<coverage::PointDefinition>& points) const;
  void add_values(const Subject& subject, std::uint64_t at_least,
                  std::vector<coverage::PointDefinition>& points,
                  std::vector<std::string>& without_range) const;

  std::size_t component_;
  const core::UnitDescription& description_;
};

}  // namespace stride::scenario

#endif
