#ifndef STRIDE_MASTER_STUDY_COMPARE_SIGNALS_SIGNAL_TALLY_H
#define STRIDE_MASTER_STUDY_COMPARE_SIGNALS_SIGNAL_TALLY_H

#include <cstdint>
#include <optional>
#include <string>

#include "master/study/compare/criteria/difference.h"

namespace stride::compare {

/// Collects the differences of one signal; they may come in any order.
class SignalTally {
 public:
  explicit SignalTally(std::string signal, bool is_boolean = false)
      : is_boolean_(is_boolean), difference_{.name = std::move(signal), .count = 0} {}

  void add(std::int64_t time, double a, double b);
  void add(std::int64_t time, const std::string& a, const std::string& b);
  /// Nothing where there was none.
  std::optional<Difference> difference() const;

 private:
  bool count(std::int64_t time);
  std::string text(double value) const;
  void widen(std::optional<Extreme>& extreme, double value, std::int64_t time, double a, double b);

  bool is_boolean_;
  Difference difference_;
};

}  // namespace stride::compare

#endif
