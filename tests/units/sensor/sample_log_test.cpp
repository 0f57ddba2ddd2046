#include "units/sensor/sample_log.h"

#include <algorithm>

#include <catch2/catch.hpp>

using sensor::SampleLog;
using stride::Duration;
using stride::Time;

TEST_CASE("the log keeps the last samples, oldest first") {
  SampleLog log;
  CHECK(log.size() == 0);
  for (std::int16_t i = 0; i < 21; ++i) {
    log.add({Time(Duration(1000 * i)), i});
    const std::int16_t held = std::min<std::int16_t>(i + 1, nfc::kLogSamples);
    REQUIRE(log.size() == static_cast<std::size_t>(held));
    for (std::int16_t k = 0; k < held; ++k) {
      const std::int16_t expected = static_cast<std::int16_t>(i - held + 1 + k);
      CHECK(log[static_cast<std::size_t>(k)].centidegrees == expected);
      CHECK(log[static_cast<std::size_t>(k)].taken == Time(Duration(1000 * expected)));
    }
  }
  log.clear();
  CHECK(log.size() == 0);
  log.add({Time(Duration(7)), 7});
  REQUIRE(log.size() == 1);
  CHECK(log[0].centidegrees == 7);
}
