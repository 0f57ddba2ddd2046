// Compares measurements with what was true when they were made.
#ifndef STRIDE_UNITS_GROUND_TRUTH_MODEL_H
#define STRIDE_UNITS_GROUND_TRUTH_MODEL_H

#include <cstdint>
#include <string>

#include <stride/time.h>

#include "units/ground_truth/history.h"
#include "units/ground_truth/quantity.h"

namespace ground_truth {

struct Parameters {
  double tolerance = 0.1;      ///< in the unit of a difference, >= 0
  stride::Duration max_age{};  ///< by which a measurement may be older than its age, >= 0
  stride::Duration memory{};   ///< for how long the truth is remembered, >= 0
  std::uint64_t minimum = 1;   ///< with fewer comparisons the verdict is not good
};

/// A measurement that was received. Its age is from `age` to `age + age_resolution`.
struct Measurement {
  stride::Time received;
  double value = 0.0;
  stride::Duration age{};
  stride::Duration age_resolution{};
};

enum class Finding : std::uint8_t {
  Right,    ///< within the tolerance of the truth at some instant at which it may have been made
  Wrong,    ///< at none
  Unknown,  ///< at none of those of which the truth is known, and of some it is not
};

/// How far a measurement is off.
struct Deviation {
  stride::Time received;
  double measured = 0.0;
  double truth = 0.0;  ///< of the values that were true when it may have been made, the nearest
  double error = 0.0;  ///< measured - truth
};

/// What became of a measurement.
struct Comparison {
  Finding finding = Finding::Unknown;
  stride::Time from, to;  ///< when it may have been made
  Deviation deviation;    ///< its truth and its error are 0 where nothing of the truth is known
};

/// A measurement is taken to have been made at one instant of the interval
///
///     [received - age - age_resolution - max_age, received - age].
///
/// Its error is the least that an instant of the interval leaves, and it is right if that is not
/// greater than the tolerance, which is a maximum permissible error (JCGM 200:2012, 4.26).
///
/// Call note() at each instant at which the truth may be another one than before, and compare()
/// after the note() of the same instant.
class Judge {
 public:
  /// All that a rollback has to bring back, beside the history's own state.
  struct State {
    std::uint64_t right = 0;
    std::uint64_t wrong = 0;
    std::uint64_t unknown = 0;
    Deviation last;   ///< of those that are right or wrong
    Deviation worst;  ///< likewise, the first one with the largest error
  };

  Judge() = default;
  /// Throws std::invalid_argument that names the parameter which is out of its range.
  Judge(const Parameters& parameters, Quantity quantity);
  /// From now on; what was found stays. Throws likewise.
  void configure(const Parameters& parameters);

  void note(stride::Time time, double truth) { history_.note(time, truth); }
  /// Throws std::invalid_argument for a value that is not finite.
  Comparison compare(const Measurement& measurement);

  std::uint64_t compared() const { return state_.right + state_.wrong; }
  /// Nothing was wrong, and enough was compared.
  bool passed() const { return state_.wrong == 0 && compared() >= parameters_.minimum; }
  /// Such as "2 of 3 measurements right; worst error 0.995 K at 24.0008 s: 22.5 degC for 21.505
  /// degC"; without a comma, for tables.
  std::string verdict_text() const;
  /// Of one that is not right, such as "measurement at 24.0008 s: 22.5 degC is wrong, error 0.995
  /// K, tolerance 0.03 K; the nearest truth between 23.9908 s and 24.0008 s is 21.505 degC".
  std::string text_of(const Comparison& comparison) const;

  History& history() { return history_; }
  const History& history() const { return history_; }
  State& state() { return state_; }
  const State& state() const { return state_; }

 private:
  void count(const Comparison& comparison);

  Parameters parameters_;
  Quantity quantity_;
  History history_;
  State state_;
};

}  // namespace ground_truth

#endif
