#include "master/study/campaign/definition/value_kind.h"

#include <cstdint>
#include <cstdlib>

#include <catch2/catch.hpp>

#include "master/study/campaign/random.h"

using namespace stride::campaign;
using KindType = ValueKind::Type;

namespace {

std::string text_of(KindType type, double number) { return number_text({.type = type}, number); }

}  // namespace

TEST_CASE("the text of a number is the shortest that reads back") {
  CHECK(text_of(KindType::Float64, 0.1) == "0.1");
  CHECK(text_of(KindType::Float32, 0.1) == "0.1");
  CHECK(text_of(KindType::Float64, 1.0 / 3) == "0.3333333333333333");
  CHECK(text_of(KindType::Float32, 1.0 / 3) == "0.33333334");
  CHECK(text_of(KindType::Whole, 2.5) == "2");
  CHECK(text_of(KindType::Whole, -2.6) == "-3");
  CHECK(text_of(KindType::Whole, -0.2) == "0");
  CHECK(text_of(KindType::Whole, 1e18) == "1000000000000000000");
  CHECK(text_of(KindType::Instant, 0.1234567890123456) == "0.123456789012");
  CHECK(text_of(KindType::Instant, -1) == "-1");
  const RandomStream stream(1, "x");
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double number = (stream.uniform(i) - 0.5) * 1e6;
    CHECK(std::strtod(text_of(KindType::Float64, number).c_str(), nullptr) == number);
  }
}

TEST_CASE("of a uniform distribution whole numbers are drawn evenly, of others the nearest ones") {
  const ValueKind whole{.type = KindType::Whole};
  CHECK(drawn_text(whole, Uniform{{1, 6}}, 0.01) == "1");
  CHECK(drawn_text(whole, Uniform{{1, 6}}, 0.16) == "1");
  CHECK(drawn_text(whole, Uniform{{1, 6}}, 0.99) == "6");
  CHECK(drawn_text(whole, Normal{2.6, 0, {}}, 0.5) == "3");
  CHECK(drawn_text(whole, ProbabilitySet{{{"x", 1}}}, 0.5) == "x");
  CHECK(drawn_text({}, Uniform{{1, 6}}, 0.5) == "3.5");
}

TEST_CASE("a seed is within its limits") {
  CHECK(seed_text({.type = KindType::Whole}, 0) == "1");
  CHECK(seed_text({.type = KindType::Whole}, UINT64_MAX) == "1");
  CHECK(seed_text({.type = KindType::Whole, .least_seed = 0}, UINT64_MAX) ==
        "18446744073709551615");
  const ValueKind dice{.type = KindType::Whole, .least_seed = 1, .most_seed = 6};
  CHECK(seed_text(dice, 5) == "6");
  CHECK(seed_text(dice, 6) == "1");
}
