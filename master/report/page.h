// The pages that show a run, a campaign and a comparison: HTML texts, to which only the data must
// be added.
#ifndef STRIDE_MASTER_REPORT_PAGE_H
#define STRIDE_MASTER_REPORT_PAGE_H

#include <string_view>

namespace stride::report {

/// It is in a page once, on a line of its own, and is replaced by the data.
inline constexpr std::string_view kDataMark = "<!-- stride:data -->";

/// The page of a run, UTF-8, made from master/report/page. Empty in a build with STRIDE_REPORT=OFF.
std::string_view page();

/// Likewise that of a campaign.
std::string_view campaign_page();

/// Likewise that of a comparison of two runs.
std::string_view comparison_page();

/// What draws worlds in 3D, for pages that have some: a script, as the blob of its bytes (UTF-8).
std::string_view world_script();
/// The licences of what that is made with: an element, and the end of its line.
std::string_view world_licences();

}  // namespace stride::report

#endif
