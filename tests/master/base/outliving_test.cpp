#include "master/base/outliving.h"

#include <functional>
#include <vector>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

using stride::core::Outliving;
using stride::core::OutlivingMemory;

namespace {

struct Number {
  static constexpr std::size_t kMostOutliving = 3;
  int value = 0;
};

void share_once() {
  static const bool is_shared = [] {
    Outliving<Number>::share();
    return true;
  }();
  CHECK(is_shared);
}

/// In a process that ends without destructors.
void in_fork(const std::function<void()>& work) {
  const pid_t process = ::fork();
  if (process == 0) {
    work();
    ::_exit(0);
  }
  int status = -1;
  ::waitpid(process, &status, 0);
  REQUIRE(status == 0);
}

std::vector<int> left() {
  std::vector<int> values;
  Outliving<Number>::for_each_left([&](const Number& number) { values.push_back(number.value); });
  return values;
}

}  // namespace

TEST_CASE("objects of a process that has ended can be read, and those that have gone cannot") {
  share_once();
  CHECK(left().empty());
  in_fork([] {
    auto& kept = *new Outliving<Number>;
    const Outliving<Number> gone(Number{5});
    kept->value = 7;
    { const Outliving<Number> earlier(Number{6}); }
    ::_exit(gone->value == 5 ? 0 : 1);
  });
  CHECK(left() == std::vector{7, 5});
  {
    Outliving<Number> last(Number{8});
    CHECK(left() == std::vector{7, 5, 8});
    const Outliving<Number> beyond(Number{9});  // on the heap
    CHECK(beyond->value == 9);
    CHECK(left() == std::vector{7, 5, 8});
  }
  CHECK(left() == std::vector{7, 5});
}

TEST_CASE("a process that has left the memory reaches no other one's") {
  share_once();
  const std::vector<int> before = left();
  in_fork([] {
    OutlivingMemory::leave();
    Outliving<Number>::for_each_left([](Number&) { ::_exit(1); });
    new Outliving<Number>(Number{10});
    ::_exit(OutlivingMemory::is_shared() ? 1 : 0);
  });
  CHECK(left() == before);
}
