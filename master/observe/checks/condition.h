// What a value is compared with.
#ifndef STRIDE_MASTER_OBSERVE_CHECKS_CONDITION_H
#define STRIDE_MASTER_OBSERVE_CHECKS_CONDITION_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/model/description.h"
#include "master/engine/model/values.h"
#include "master/engine/run/verdict.h"

namespace stride::checks {

/// NotANumber: the value is NaN, which neither holds nor fails to hold.
enum class Truth : std::uint8_t { False, True, NotANumber };

/// How a value stands to a condition.
struct Judgement {
  Truth truth = Truth::True;
  /// How far the value is within what the condition allows, or, if negative, outside of it, in the
  /// variable's unit of measure; at a limit 0, whether the limit is allowed or not. Of what has no
  /// order 1 where the condition holds, else -1. NaN is infinitely far outside. Never NaN itself.
  double robustness = 0;
};

/// As a person writes it: bounds that all have to be kept, or the value that is expected.
struct ConditionText {
  std::optional<std::string> min;    ///< at least
  std::optional<std::string> max;    ///< at most
  std::optional<std::string> above;  ///< more than
  std::optional<std::string> below;  ///< less than
  std::optional<std::string> equals;
  std::optional<std::string> tolerance;  ///< how far a real number may be from `equals`, inclusive
};

/// A comparison of one element of a variable, in the variable's own type and unit of measure.
class Condition {
 public:
  /// Throws std::invalid_argument, whose text contains what was expected, where nothing is compared
  /// or no value could meet it, for bounds of what has no order (only numbers have), a tolerance of
  /// what is not a real number, and values that are not finite or not of the variable's type.
  Condition(const core::Variable& variable, const ConditionText& text);

  /// Of the element of a block of the variable's type. Does not allocate.
  Judgement judge(const core::ValueBlock& block, std::size_t element) const;
  Truth holds(const core::ValueBlock& block, std::size_t element) const {
    return judge(block, element).truth;
  }
  /// By the names of their attributes.
  std::vector<core::SignalLimits::Limit> limits() const;
  /// ">= 1.8 V and <= 5 V", "= true"
  const std::string& text() const { return text_; }
  /// A human-readable value: "1.79 V", "charging", "'on'", "no bytes".
  std::string value_text(const core::ValueBlock& block, std::size_t element) const;

 private:
  using Bound = std::optional<core::ValueBlock>;

  Bound parse(const char* attribute, const std::optional<std::string>& text) const;
  void read_bounds(const ConditionText& text);
  void read_expected(const ConditionText& text);
  void check_order(const char* low_name, const Bound& low, const char* high_name, const Bound& high,
                   bool may_be_equal) const;
  void describe(const char* sign, const Bound& bound);
  template <class T>
  Judgement judge_number(T value) const;

  core::Variable variable_;  ///< scalar
  Bound min_, max_, above_, below_, equals_, tolerance_;
  bool has_order_ = true;
  std::string text_;
};

}  // namespace stride::checks

#endif
