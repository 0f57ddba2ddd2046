// A search through a campaign, with its cases in a folder.
#ifndef STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_COURSE_H
#define STRIDE_MASTER_FRONT_CLI_CAMPAIGN_SEARCH_SEARCH_COURSE_H

#include <utility>

#include "master/front/cli/campaign/cases/campaign_input.h"
#include "master/front/cli/campaign/search/listed_cases.h"
#include "master/study/search/search.h"
#include "master/study/search/search_space.h"

namespace stride::cli {

/// Follows the records that there are, and hands each generation that is not complete to `run`.
struct SearchCourse {
  SearchCourse(const search::Request& request, const CampaignInput& input, RunBatch run)
      : space(input.plan().campaign(), input.plan().kinds()),
        cases(input.plan(), seeds_of(input.plan(), input.plan().at(0)), input.folder(),
              std::move(run)),
        search(request, space, cases) {}
  SearchCourse(const SearchCourse&) = delete;
  SearchCourse& operator=(const SearchCourse&) = delete;

  const search::SearchSpace space;
  ListedCases cases;
  search::Search search;
};

}  // namespace stride::cli

#endif
