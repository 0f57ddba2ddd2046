#include "master/base/text/listed.h"

#include <memory>
#include <set>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

using stride::core::Listed;

namespace {

struct Item {
  explicit Item(int number) : number(number) {}
  int number;
  Listed<Item> listed{*this};
};

std::set<int> numbers() {
  std::set<int> found;
  Listed<Item>::for_each([&](const Item& item) { CHECK(found.insert(item.number).second); });
  return found;
}

}  // namespace

TEST_CASE("objects are listed for as long as they live, in whatever order they end") {
  CHECK(numbers().empty());
  std::vector<std::unique_ptr<Item>> items;
  for (int i = 0; i < 4; ++i) items.push_back(std::make_unique<Item>(i));
  CHECK(numbers() == std::set{0, 1, 2, 3});
  items[3].reset();  // the first, one in the middle, the last
  CHECK(numbers() == std::set{0, 1, 2});
  items[1].reset();
  CHECK(numbers() == std::set{0, 2});
  items[0].reset();
  CHECK(numbers() == std::set{2});
  items.clear();
  CHECK(numbers().empty());
}

TEST_CASE("objects of many threads are listed") {
  const Item stays(-1);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([i] {
      for (int k = 0; k < 1000; ++k) const Item item(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(numbers() == std::set{-1});
}
