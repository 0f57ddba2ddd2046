#include "master/base/sparse_clock.h"

#include <chrono>
#include <thread>

#include <catch2/catch.hpp>

TEST_CASE("a clock is read at each call where they are far apart") {
  stride::core::SparseClock clock;
  for (int i = 0; i < 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto before = clock.now();
    CHECK(clock.read());
    CHECK(clock.now() - before >= std::chrono::milliseconds(1));
  }
}

TEST_CASE("a clock is not read at each call where they follow each other quickly") {
  stride::core::SparseClock clock;
  int reads = 0;
  for (int i = 0; i < 100000; ++i) reads += clock.read() ? 1 : 0;
  CHECK(reads > 0);
  CHECK(reads < 100000);
}
