// Points of the values of a signal.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_SIGNAL_POINT_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_SIGNAL_POINT_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "master/engine/port/observer.h"
#include "master/observe/coverage/point.h"

namespace stride::coverage {

/// Values and Transitions. A value is sampled at a communication point, and counts as soon as a
/// step has begun with it.
class SignalPoint final : public Point {
 public:
  using Point::Point;

  /// Before the first communication point: where its value will be.
  void attach(const core::Signal& signal) {
    block_ = signal.block;
    at_ = signal.first + definition_.element;
  }
  void sample() { sampled_ = bin_of(*definition_.classes, *block_, at_); }
  /// A step has begun with what was sampled at this time. Returns whether it is in another bin than
  /// the sample that counted before.
  bool commit(Time time) {
    if (sampled_ == counted_) return false;
    count_change(time);
    counted_ = sampled_;
    return true;
  }

  std::size_t latest() const override { return sampled_; }
  void persist(core::StateArchive& state) override;

 private:
  void count_change(Time time);

  const core::ValueBlock* block_ = nullptr;
  std::size_t at_ = 0;
  std::size_t sampled_ = kNoBin;
  std::size_t counted_ = kNoBin;
};

/// Combinations of bins. A bin of a part that is ignored is in no combination.
class CrossPoint final : public Point {
 public:
  /// `parts`: of a signal's values, or of one variable's messages; they must outlive it.
  CrossPoint(const PointDefinition& definition, std::vector<const Point*> parts);

  /// The variable of the parts that are messages, if there are any.
  const core::VariableId* event() const { return event_; }
  /// A message: counts the combination of the latest bins of its parts, if each has one.
  void visit(Time time);
  /// Likewise of values, where it is another combination than the one before.
  void visit_changed(Time time);
  void persist(core::StateArchive& state) override;

 private:
  struct Combination {
    std::uint64_t key;
    std::size_t bin;
  };

  std::optional<std::uint64_t> latest_key() const;
  std::size_t find_or_add(std::uint64_t key);
  void add_declared();

  std::vector<const Point*> parts_;
  const core::VariableId* event_ = nullptr;
  std::vector<Combination> combinations_;  ///< by key
  std::optional<std::uint64_t> last_;      ///< of visit_changed()
  std::string name_;                       ///< of one that is new
};

}  // namespace stride::coverage

#endif
