// Inputs for a single unit.
#ifndef STRIDE_MASTER_STUDY_VERIFY_STIMULUS_H
#define STRIDE_MASTER_STUDY_VERIFY_STIMULUS_H

#include <cstdint>
#include <utility>
#include <vector>

#include "master/engine/model/values.h"
#include "master/engine/port/unit.h"
#include "master/study/verify/tested_unit.h"

namespace stride::verify {

/// Gives each numeric input of a unit a course of its own, a function of the seed and of the number
/// of the communication point alone. Continuous inputs swing smoothly from the start value to
/// another one and back; the others change between two values, some steps apart. Both values are
/// within min and max. Texts, bytes and inputs that the user has set stay what they are, and so do
/// clocked inputs but at the ticks of their clock.
class Stimulus {
 public:
  Stimulus(const TestedUnit& tested, std::uint64_t seed);
  virtual ~Stimulus() = default;

  struct Input {
    std::size_t variable;  ///< its index in the description
    core::ValueReference reference;
    bool is_continuous;
    bool is_clocked;
    core::ValueBlock start, other;
    double cycle;      ///< [steps] of a continuous one
    std::size_t hold;  ///< [steps] between two changes of the others
  };
  const std::vector<Input>& inputs() const { return inputs_; }

  /// Whether an input that is neither continuous nor clocked has another value at point k than at
  /// point k - 1.
  virtual bool changes_at(std::size_t k) const;
  virtual core::ValueBlock value(const Input& input, std::size_t k) const;
  /// Whether Event Mode is entered at point k without a reason, and triggered clocks tick.
  virtual bool ticks_at(std::size_t k) const;

 private:
  std::vector<Input> inputs_;
};

/// A uniform number in [0, 1), a function of both alone.
double uniform(std::uint64_t seed, std::uint64_t index);

/// The least and the greatest value of a Float64 that the description allows, those of its type
/// where it declares none.
std::pair<double, double> range_of(const core::Variable& variable);

/// Another value than `start` that is allowed for the variable, near it; `start` itself where there
/// is none.
core::ValueBlock other_value(const core::Variable& variable, const core::ValueBlock& start);

/// Whether start_value() knows the value: of an array of texts or bytes a description has no text
/// in which the elements are distinguished.
bool has_start_value(const core::Variable& variable);

/// A value that a description gives as text, or zeros where it gives none.
core::ValueBlock start_value(const core::Variable& variable);

}  // namespace stride::verify

#endif
