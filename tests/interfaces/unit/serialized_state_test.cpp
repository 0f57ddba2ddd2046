#include "interfaces/unit/serialized_state.h"

#include <algorithm>
#include <iterator>
#include <tuple>

#include <catch2/catch.hpp>

#include "interfaces/unit/misuse.h"

using Catch::Matchers::Contains;
using stride::kit::Misuse;
using stride::kit::SerializedState;
using stride::kit::StateIdentity;

namespace {

using Bytes = std::vector<std::uint8_t>;

const StateIdentity kTank{"tank", "stride-1", 17, true};

Bytes write(const StateIdentity& identity, const Bytes& state) {
  const SerializedState serialized(identity);
  Bytes bytes(serialized.size(state));
  serialized.write(state, bytes.data());
  return bytes;
}

void check(const StateIdentity& identity, const Bytes& bytes) {
  SerializedState(identity).check(bytes.data(), bytes.size());
}

std::string why(const StateIdentity& identity, const Bytes& bytes) {
  try {
    check(identity, bytes);
  } catch (const Misuse& misuse) {
    return misuse.what();
  }
  return "";
}

class Listing : public stride::Unit {
 public:
  void step(stride::Step&) override {}
  template <class... Members>
  explicit Listing(Members&... members) {
    state(members...);
  }
};

template <class... Members>
std::uint64_t layout() {
  std::tuple<Members...> members;
  return std::apply([](auto&... each) { return stride::kit::layout_of_state(Listing(each...)); },
                    members);
}

}  // namespace

TEST_CASE("what was written is found again") {
  for (const Bytes& state : {Bytes{}, Bytes{1, 2, 3, 4, 5}}) {
    const Bytes bytes = write(kTank, state);
    const std::size_t begin = SerializedState(kTank).check(bytes.data(), bytes.size());
    CHECK(Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end()) == state);
    CHECK(write(kTank, state) == bytes);
  }
}

TEST_CASE("each changed bit is found, and each other length") {
  const Bytes bytes = write(kTank, {1, 2, 3, 4, 5});
  for (std::size_t i = 0; i < 8 * bytes.size(); ++i) {
    Bytes flipped = bytes;
    flipped[i / 8] ^= static_cast<std::uint8_t>(1U << (i % 8));
    CHECK_THROWS_AS(check(kTank, flipped), Misuse);
  }
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    CHECK_THROWS_AS(
        check(kTank, Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))),
        Misuse);
  }
  Bytes longer = bytes;
  longer.push_back(0);
  CHECK_THROWS_AS(check(kTank, longer), Misuse);
}

TEST_CASE("the message says what was expected and what is there") {
  const Bytes bytes = write(kTank, {1, 2, 3});
  CHECK_THAT(why(kTank, Bytes(64, 'x')), Contains("do not begin with 'stridest'"));
  Bytes of_other_format = bytes;
  of_other_format[8] = 9;
  CHECK_THAT(why(kTank, of_other_format), Contains("of format 9, expected 1"));
  CHECK_THAT(why({"well", "stride-1", 17, true}, bytes),
             Contains("of the unit 'tank', expected 'well'"));
  CHECK_THAT(
      why({"tank", "stride-2", 17, true}, bytes),
      Contains("another version of 'tank'") && Contains("token 'stride-1', expected 'stride-2'"));
  CHECK_THAT(why({"tank", "stride-1", 18, true}, bytes), Contains("state() lists other members"));
  CHECK_THAT(why({"tank", "stride-1", 17, false}, bytes),
             Contains("an instance with Event Mode (eventModeUsed), expected one without"));
}

TEST_CASE("members that are not written alike have another layout") {
  struct Two {
    double one, other;
  };
  const std::uint64_t all[] = {layout<>(),
                               layout<double>(),
                               layout<float>(),
                               layout<std::int64_t>(),
                               layout<std::uint64_t>(),
                               layout<std::uint32_t>(),
                               layout<double, double>(),
                               layout<Two>(),
                               layout<std::vector<double>>(),
                               layout<std::optional<double>>(),
                               layout<std::vector<Two>>(),
                               layout<std::string>(),
                               layout<double, float>(),
                               layout<float, double>()};
  for (const std::uint64_t& one : all) CHECK(std::count(std::begin(all), std::end(all), one) == 1);
  CHECK(layout<std::vector<double>>() == layout<std::deque<double>>());
}
