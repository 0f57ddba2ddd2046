#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_SIGNAL_TALLY_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_SIGNAL_TALLY_H

#include <optional>
#include <string>

#include <stride/time.h>

#include "master/study/compare/criteria/difference.h"

namespace stride::compare {

/// Collects the differences of one signal; they may come in any order.
class SignalTally {
 public:
  explicit SignalTally(std::string signal, bool is_boolean = false)
      : is_boolean_(is_boolean), difference_{.name = std::move(signal), .count = 0} {}

  void add(Time time, double a, double b);
  void add(Time time, const std::string& a, const std::string& b);
  /// Nothing where there was none.
  std::optional<Difference> difference() const;

 private:
  bool count(Time time);
  std::string text(double value) const;
  void widen(std::optional<Extreme>& extreme, double value, Time time, double a, double b);

  bool is_boolean_;
  Difference difference_;
};

}  // namespace stride::compare

#endif
