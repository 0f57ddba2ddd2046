// The coverage of a scenario as it is written.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_COVERAGE_DECLARATION_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_COVERAGE_DECLARATION_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/base/xml/element.h"
#include "master/observe/coverage/definition.h"

namespace stride::scenario {

using PointKind = coverage::Kind;

/// An element in <stride:Group>; which of the members it has depends on its kind.
struct PointDeclaration {
  PointKind kind = PointKind::Values;
  std::string name{};     ///< empty: to be made from the rest
  std::string subject{};  ///< the name or a glob of signals or messages of the component
  std::optional<std::uint64_t> at_least{};
  std::optional<double> min{};  ///< Values, Transitions
  std::optional<double> max{};
  std::optional<std::uint64_t> bins{};  ///< Values
  bool is_logarithmic = false;
  std::vector<double> edges{};
  std::vector<std::string> words{};         ///< Words, Sequences
  std::optional<std::uint64_t> greatest{};  ///< Lengths
  std::optional<Duration> shortest{};       ///< Gaps
  std::optional<Duration> longest{};
  std::vector<std::string> of{};  ///< Cross
  core::Location where{};
};

/// <stride:Ignore>: names or globs.
struct IgnoreDeclaration {
  std::string points;
  std::string bins;
  core::Location where{};
};

struct GroupDeclaration {
  std::string component;
  std::optional<double> goal{};
  std::uint64_t at_least = 1;
  std::vector<PointDeclaration> points{};  ///< none: automatic ones
  std::vector<IgnoreDeclaration> ignored{};
  core::Location where{};
};

/// <stride:Covered>, a check.
struct CoveredDeclaration {
  std::string name;  ///< empty: to be made from the rest
  std::string component;
  std::optional<std::string> points{};  ///< a name or a glob; nothing: the group
  double min = 0;
  core::Location where{};
};

/// Of the element that declares such a point: "Values".
const char* element_name(PointKind kind);

/// Reads <stride:Coverage>, and the <stride:Covered> in <stride:Checks>. Both throw core::Error
/// (Input) for what is unknown, missing or no number.
std::vector<GroupDeclaration> read_coverage(const xml::Element& coverage);
std::vector<CoveredDeclaration> read_covered(const xml::Element& checks);

}  // namespace stride::scenario

#endif
