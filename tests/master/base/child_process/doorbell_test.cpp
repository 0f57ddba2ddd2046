#include "master/base/child_process/doorbell.h"

#include <atomic>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "master/base/child_process/shared_memory.h"

using namespace stride::isolation;
using namespace std::chrono_literals;

namespace {

struct Table {
  std::atomic<int> ping = 0, pong = 0;
  Doorbell for_ping, for_pong;
};

void wait(Waiter& waiter, Doorbell& doorbell, const std::atomic<int>& number, int value) {
  while (!waiter.wait(doorbell, 10s, [&] { return number == value; })) {
  }
}

}  // namespace

TEST_CASE("two processes answer each other, and lose no ring") {
  const Shared<Table> table;
  constexpr int kRounds = 20'000;
  Waiter waiter;
  const pid_t child = ::fork();
  if (child == 0) {
    for (int i = 1; i <= kRounds; ++i) {
      wait(waiter, table->for_ping, table->ping, i);
      if (i % 1000 == 0) table->for_ping.sleep(table->for_ping.rings(), 1ms);  // who waits sleeps
      table->pong = i;
      table->for_pong.ring();
    }
    ::_exit(0);
  }
  REQUIRE(child > 0);
  for (int i = 1; i <= kRounds; ++i) {
    table->ping = i;
    table->for_ping.ring();
    wait(waiter, table->for_pong, table->pong, i);
  }
  int status = -1;
  CHECK(::waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}

TEST_CASE("a sleep ends when its time is over, and does not begin after a ring") {
  Doorbell doorbell;
  const auto rings = doorbell.rings();
  doorbell.sleep(rings, 1ms);
  doorbell.ring();
  doorbell.sleep(rings, 1h);
  CHECK(doorbell.rings() == rings + 1);
}
