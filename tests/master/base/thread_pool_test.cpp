#include "master/base/thread_pool.h"

#include <csignal>
#include <numeric>
#include <set>

#include <catch2/catch.hpp>
#include <pthread.h>

using namespace stride::core;
using namespace std::chrono_literals;

namespace {

void add_one(std::vector<int>& numbers, ThreadPool& pool) {
  pool.run(numbers.size(), [&](std::size_t k) noexcept { ++numbers[k]; });
}

}  // namespace

TEST_CASE("each task is done once a batch, and what it wrote is seen") {
  const std::size_t threads = GENERATE(1, 2, 3, 8);
  ThreadPool pool(threads);
  REQUIRE(pool.threads() == threads);
  std::vector<int> numbers(threads);  // no atomics: the pool orders the accesses
  for (int batch = 0; batch < 2000; ++batch) add_one(numbers, pool);
  CHECK(numbers == std::vector<int>(threads, 2000));
}

TEST_CASE("a batch may be smaller than the pool") {
  ThreadPool pool(4);
  std::vector<int> two(2);
  std::vector<int> four(4);
  for (int batch = 0; batch < 500; ++batch) {
    add_one(two, pool);
    add_one(four, pool);
  }
  CHECK(two == std::vector<int>(2, 500));
  CHECK(four == std::vector<int>(4, 500));
}

TEST_CASE("a task has the same thread in every batch, the first one the caller's") {
  ThreadPool pool(3);
  std::vector<std::set<std::thread::id>> seen(3);
  for (int batch = 0; batch < 50; ++batch) {
    pool.run(3, [&](std::size_t k) noexcept { seen[k].insert(std::this_thread::get_id()); });
  }
  CHECK(seen[0] == std::set{std::this_thread::get_id()});
  CHECK(seen[1].size() == 1);
  CHECK(seen[2].size() == 1);
  CHECK(seen[1] != seen[2]);
  CHECK(seen[1] != seen[0]);
}

TEST_CASE("a worker whose task cancels its thread goes on") {
  ThreadPool pool(2);
  std::vector<int> numbers(2);
  pool.run(2, [](std::size_t k) noexcept {
    if (k == 1) ::pthread_cancel(::pthread_self());
  });
  std::this_thread::sleep_for(1ms);  // until it sleeps, where it would be cancelled
  add_one(numbers, pool);
  CHECK(numbers == std::vector<int>(2, 1));
}

TEST_CASE("sleeping workers wake up, and so does the caller") {
  ThreadPool pool(3);
  std::vector<int> numbers(3);
  for (int batch = 0; batch < 20; ++batch) {
    std::this_thread::sleep_for(1ms);
    pool.run(3, [&](std::size_t k) noexcept {
      if (k == 2) std::this_thread::sleep_for(1ms);
      ++numbers[k];
    });
  }
  CHECK(numbers == std::vector<int>(3, 20));
}

TEST_CASE("a pool ends, whether it has worked or not") {
  for (int i = 0; i < 50; ++i) {
    ThreadPool idle(4);
    ThreadPool busy(2);
    std::vector<int> numbers(2);
    add_one(numbers, busy);
    CHECK(numbers == std::vector<int>(2, 1));
  }
}

TEST_CASE("a worker takes no signal") {
  ThreadPool pool(2);
  bool blocks_interrupt = false;
  bool blocks_segv = true;
  pool.run(2, [&](std::size_t k) noexcept {
    if (k == 0) return;
    sigset_t blocked;
    pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
    blocks_interrupt = sigismember(&blocked, SIGINT) == 1;
    blocks_segv = sigismember(&blocked, SIGSEGV) == 1;
  });
  CHECK(blocks_interrupt);
  CHECK_FALSE(blocks_segv);
}

TEST_CASE("the hand-over is measured") {
  ThreadPool pool(2);
  CHECK(pool.measure_hand_over() > 0ns);
}
