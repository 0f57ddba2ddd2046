// What a search varies: the parameters of a campaign as coordinates.
#ifndef STRIDE_MASTER_STUDY_SEARCH_SEARCH_SPACE_H
#define STRIDE_MASTER_STUDY_SEARCH_SEARCH_SPACE_H

#include <cstddef>
#include <vector>

#include "master/study/campaign/definition/definition.h"
#include "master/study/campaign/definition/value_kind.h"
#include "master/study/search/search_method.h"

namespace stride::search {

/// A coordinate for each stochastic parameter, whose value is the quantile of its distribution, and
/// for each deterministic factor, whose sets and steps have equal parts of the interval. What a
/// campaign would draw often has much room, and what it would never draw has none.
class SearchSpace {
 public:
  /// The arguments must outlive it: the campaign, and the kinds of the columns of its plan. Throws
  /// core::Error (Input) for a campaign in which nothing varies.
  SearchSpace(const campaign::Campaign& campaign, const std::vector<campaign::ValueKind>& kinds);

  std::size_t dimensions() const { return dimensions_; }
  /// One for each of Campaign::parameters.
  std::vector<campaign::Text> values(const Point& point) const;
  /// The case without any of them: all as in the scenario.
  std::vector<campaign::Text> nominal() const;

 private:
  const campaign::Campaign& campaign_;
  const std::vector<campaign::ValueKind>& kinds_;
  std::size_t dimensions_;
};

}  // namespace stride::search

#endif
