// In place of the pages where the build leaves them out (STRIDE_REPORT=OFF).
#include "master/report/page.h"

namespace stride::report {

std::string_view page() { return {}; }
std::string_view campaign_page() { return {}; }
std::string_view comparison_page() { return {}; }
std::string_view world_script() { return {}; }
std::string_view world_licences() { return {}; }

}  // namespace stride::report
