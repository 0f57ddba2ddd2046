#include "master/study/campaign/cases/case_range.h"

#include <catch2/catch.hpp>

using namespace stride::campaign;

TEST_CASE("a range of cases is read as it is written") {
  for (const CaseRange& range : {CaseRange{0, 0}, {20, 29}, {7, 9'999'999}}) {
    CHECK(parse_case_range(to_text(range)) == range);
  }
  CHECK(to_text({20, 29}) == "20-29");
  CHECK(to_text({20, 20}) == "20");
  CHECK(CaseRange{20, 29}.size() == 10);
}

TEST_CASE("what is no range of cases is none") {
  for (const char* text :
       {"", "-", "3-", "-3", "4-3", "1-2-3", "a", "1 - 2", "1.5", "+1", "99999999999999999999"}) {
    INFO(text);
    CHECK_FALSE(parse_case_range(text));
  }
}
