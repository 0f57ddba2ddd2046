// One coverpoint while a run goes on.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_POINT_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_POINT_H

#include <cstddef>

#include "master/base/state_archive.h"
#include "master/observe/coverage/definition.h"
#include "master/observe/coverage/tally.h"

namespace stride::coverage {

class Point {
 public:
  /// The definition must outlive it.
  explicit Point(const PointDefinition& definition) : definition_(definition), tally_(definition) {}
  virtual ~Point() = default;
  Point(const Point&) = delete;
  Point& operator=(const Point&) = delete;

  const PointDefinition& definition() const { return definition_; }
  const Tally& tally() const { return tally_; }
  /// The bin of the latest value or message, or kNoBin; a cross asks for it.
  virtual std::size_t latest() const { return kNoBin; }
  /// What it has seen, between two communication points.
  virtual void persist(core::StateArchive& state) = 0;

 protected:
  const PointDefinition& definition_;
  Tally tally_;
};

}  // namespace stride::coverage

#endif
