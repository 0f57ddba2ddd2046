// Mistakes in the input, collected and reported together.
#ifndef STRIDE_MASTER_BASE_DIAGNOSTICS_H
#define STRIDE_MASTER_BASE_DIAGNOSTICS_H

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "master/base/error.h"

namespace stride::core {

/// Collects what is wrong with the input while the rest of it is checked.
class Diagnostics {
 public:
  /// So that the work for a file of mistakes only is bounded.
  static constexpr std::size_t kMostKept = 1000;

  /// Calls `check`, and keeps the Error of the kind Input that it throws. Returns whether it threw
  /// none. Throws as raise() does when there are kMostKept.
  template <class Check>
  bool attempt(Check&& check) {
    try {
      std::forward<Check>(check)();
      return true;
    } catch (const Error& mistake) {
      if (mistake.kind() != Error::Kind::Input) throw;
      kept_.push_back(mistake);
    }
    if (kept_.size() == kMostKept) raise();
    return false;
  }

  bool any() const { return !kept_.empty(); }
  /// Whether one of them concerns this variable or connector of a unit.
  bool mentions(const std::string& unit, const std::string& variable) const;

  /// What is said of a unit above its mistakes, if there are several and all are about it: where
  /// it is named, and a text that sums them up.
  void sum_up(const std::string& unit, Location where, std::string text);

  /// Throws what was kept, if anything was: a single mistake as it is, several as one Error with a
  /// line for each, those about one unit together, in the order in which they were found.
  void raise() const;

 private:
  struct Summary {
    Location where;
    std::string text;
  };
  [[noreturn]] void raise_of_unit(const std::string& unit, const std::string& count,
                                  const std::string& lines, const std::string& hints) const;

  std::vector<Error> kept_;
  std::map<std::string, Summary> summaries_;  ///< by the unit
};

}  // namespace stride::core

#endif
