#include "master/study/campaign/definition/decimal.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/error_of.h"

using namespace stride::campaign;
using Catch::Contains;

namespace {

std::vector<std::string> steps(const char* first, const char* step, const char* last) {
  const Decimal from = parse_decimal(first), by = parse_decimal(step);
  std::vector<std::string> texts;
  const std::uint64_t count = count_steps(from, by, parse_decimal(last)).value();
  for (std::uint64_t i = 0; i < count; ++i) texts.push_back(step_text(from, by, i));
  return texts;
}

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("steps are exact, and the last value is one where it is reached") {
  CHECK(steps("0.1", "0.1", "0.7") == Texts{"0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7"});
  CHECK(steps("1.1", "0.2", "1.5") == Texts{"1.1", "1.3", "1.5"});
  CHECK(steps("0", "0.3", "1") == Texts{"0", "0.3", "0.6", "0.9"});
  CHECK(steps("-1", "0.50", "1e0") == Texts{"-1", "-0.5", "0", "0.5", "1"});
  CHECK(steps("5", "5", "5") == Texts{"5"});
  CHECK(steps("1e-9", "1E-9", "3e-9") == Texts{"1e-09", "2e-09", "3e-09"});
  CHECK(steps("1e20", "5e19", "2e+20") == Texts{"1e+20", "1.5e+20", "2e+20"});
  CHECK(steps("99.5", "0.25", "100.5") == Texts{"99.5", "99.75", "100", "100.25", "100.5"});
}

TEST_CASE("a step's text reads back as the number that it stands for") {
  for (const char* step : {"0.1", "0.0001", "3e-7", "12345.6789", "1e15", "4e30"}) {
    for (std::uint64_t i = 1; i < 60; ++i) {
      const std::string text = step_text({}, parse_decimal(step), i);
      CAPTURE(step, i, text);
      CHECK(std::stod(text) == Approx(std::stod(step) * static_cast<double>(i)).epsilon(1e-15));
    }
  }
}

TEST_CASE("what is no decimal, and what is too far apart, is refused") {
  const auto error = [](const std::string& text) {
    return stride::tests::error_of([&] { parse_decimal(text); });
  };
  for (const char* text : {"", "-", "one", "1.2.3", "1e", "1e+-2", "0x10", " 1", "inf", "nan"}) {
    CAPTURE(text);
    CHECK_THAT(error(text), Contains("is not a number; expected one such as 0.25 or 1e-3"));
  }
  CHECK_THAT(error("1234567890123456789"), Contains("has more than 18 digits"));
  CHECK_THAT(error("1e999"), Contains("is out of range"));
  CHECK(count_steps(parse_decimal("0"), parse_decimal("1e-10"), parse_decimal("1e10")) ==
        std::nullopt);
}
