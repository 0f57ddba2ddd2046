// Looks for the case that fails.
#ifndef STRIDE_MASTER_STUDY_SEARCH_SEARCH_H
#define STRIDE_MASTER_STUDY_SEARCH_SEARCH_H

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "master/study/campaign/cases/case_record.h"
#include "master/study/campaign/definition/definition.h"
#include "master/study/search/objective.h"
#include "master/study/search/search_method.h"
#include "master/study/search/search_space.h"

namespace stride::search {

/// Values of the parameters of a campaign.
using Row = std::vector<campaign::Text>;

/// Cases that are made up one batch after the other.
class Cases {
 public:
  virtual ~Cases() = default;
  /// Runs further cases. False if it was interrupted: then they are not there.
  virtual bool add(std::vector<Row> rows) = 0;
  virtual std::size_t size() const = 0;
  virtual const campaign::CaseResult& result(std::uint64_t index) const = 0;
};

struct Request {
  Method method = Method::CmaEs;
  std::uint64_t seed = 1;
  std::uint64_t runs = 200;  ///< at most, 1 at least
  std::string check{};       ///< whose margin alone is minimised; empty: all
  bool finds_all = false;    ///< it goes on behind the first failure, and looks for others
  MakeOptimiser* make_optimiser = nullptr;  ///< see SearchMethod
};

/// Case 0 is the nominal one, without any value of the campaign. The others are functions of the
/// request, the space, and the results; a failure is found once.
class Search {
 public:
  struct Found {
    std::string failure;
    std::uint64_t index = 0;  ///< of the first case that has it
  };

  /// Both must outlive it.
  Search(const Request& request, const SearchSpace& space, Cases& cases);

  /// Until a failure is found, or all that can be, or the runs are used up, or all cases that there
  /// are have been run. A nominal case that does not come to its end is a failure that ends it,
  /// whatever the check. Calls `on_case` behind each. False if it was interrupted. Throws
  /// core::Error (Input) if there is no such check.
  bool run(const std::function<void(std::uint64_t index)>& on_case);

  const std::vector<Found>& found() const { return found_; }
  /// The case that is the nearest to a failure; nothing once one is found, and where none is nearer
  /// than another.
  const std::optional<std::uint64_t>& nearest() const { return nearest_; }

 private:
  void begin_method();
  void require_check() const;
  bool is_over() const;
  bool run_generation(const std::function<void(std::uint64_t index)>& on_case);
  void note(std::uint64_t index);

  const Request request_;
  const SearchSpace& space_;
  Cases& cases_;
  std::optional<Objective> objective_;
  std::optional<SearchMethod> method_;
  std::map<Row, std::uint64_t> known_;
  std::vector<Found> found_;
  double least_ = std::numeric_limits<double>::infinity();  ///< of the objective
  std::optional<std::uint64_t> nearest_;
  int generations_without_case_ = 0;
};

}  // namespace stride::search

#endif
