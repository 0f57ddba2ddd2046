#include "master/base/limited_warnings.h"

#include <catch2/catch.hpp>

using stride::core::LimitedWarnings;

namespace {

std::vector<std::string> warned(std::size_t count) {
  std::vector<std::string> warnings{"another"};
  LimitedWarnings limited(warnings, "mistakes");
  for (std::size_t i = 0; i < count; ++i) {
    if (limited.count()) limited.add("a mistake");
  }
  limited.finish();
  return warnings;
}

}  // namespace

TEST_CASE("the first warnings of a kind are shown, the others counted") {
  constexpr std::size_t kMost = LimitedWarnings::kMostShown;
  CHECK(warned(0).size() == 1);
  CHECK(warned(kMost).size() == 1 + kMost);
  CHECK(warned(kMost + 7).size() == 2 + kMost);
  CHECK(warned(kMost + 7).back() == "… and 7 more mistakes");
}
