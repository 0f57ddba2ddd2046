// The checks of a scenario as they are written.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_CHECK_DECLARATION_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_CHECK_DECLARATION_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/base/xml/element.h"
#include "master/observe/checks/condition.h"
#include "master/observe/checks/definition.h"

namespace stride::scenario {

/// One element in <stride:Checks>; which of the members it has depends on its kind.
struct CheckDeclaration {
  checks::Kind kind = checks::Kind::Always;
  std::string name;  ///< empty: to be made from the rest
  /// A name or a glob of signals (Always, Never, Eventually, Final) or messages (Count), or the
  /// name of the request (Answer).
  std::string subject;
  checks::ConditionText condition{};
  std::string ending_signal{};  ///< Until: the one that ends it
  checks::ConditionText ending{};
  checks::Window window{};
  std::optional<std::uint64_t> min{};  ///< Count
  std::optional<std::uint64_t> max{};
  std::string reply{};  ///< Answer
  Duration within{};
  bool repeats = false;
  core::Location where{};
};

/// Reads <stride:Checks>, but for what read_covered() reads. Throws core::Error (Input) for what is
/// unknown, missing or no number, and for an interval or a count that ends before it begins.
std::vector<CheckDeclaration> read_checks(const xml::Element& checks);

}  // namespace stride::scenario

#endif
