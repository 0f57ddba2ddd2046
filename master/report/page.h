// The page that shows a run: one HTML text, to which only the run's data must be added.
#ifndef STRIDE_MASTER_REPORT_PAGE_H
#define STRIDE_MASTER_REPORT_PAGE_H

#include <string_view>

namespace stride::report {

/// It is in the page once, on a line of its own, and is replaced by the run's data.
inline constexpr std::string_view kDataMark = "<!-- stride:data -->";

/// The page, UTF-8, made from master/report/page. Empty in a build with STRIDE_REPORT=OFF.
std::string_view page();

}  // namespace stride::report

#endif
