#include "interfaces/unit/table.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>

#include <catch2/catch.hpp>

using namespace stride;
using Catch::Matchers::Contains;

namespace {

/// A unit with the rows that a test wants.
class Rows : public Unit {
 public:
  explicit Rows(const std::function<void(Rows&)>& list) { list(*this); }
  void step(Step&) override {}

  using Unit::describe;
  using Unit::input;
  using Unit::output;
  using Unit::parameter;

  double real = 0;
  float narrow = 0;
  std::int8_t small = 0;
  std::uint32_t natural = 0;
  std::int64_t integer = 0;
  std::uint64_t large = 0;
  bool flag = false;
  bool other_flag = false;
  std::string text;
  Binary bytes;
  Clock clock;
};

void check(const std::function<void(Rows&)>& list) {
  const Rows unit(list);
  double time = 0;
  kit::Table(unit, time);
}

}  // namespace

TEST_CASE("a name that is not structured is refused with the grammar") {
  CHECK_NOTHROW(check([](Rows& unit) { unit.input("'left arm'.axes[1]", unit.real); }));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("left arm", unit.real); }),
                    Contains("variable 'left arm': this is not a structured name") &&
                        Contains("\"'left arm'.angle\""));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("", unit.real); }), Contains("no name"));
}

TEST_CASE("bounds are values of the type") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CHECK_NOTHROW(check([](Rows& unit) {
    unit.input("real", unit.real).range(-1e300, 0.5);
    unit.input("small", unit.small).range(-128, 127);
    unit.input("natural", unit.natural).range(0, 4294967295.0);
    unit.input("integer", unit.integer).range(-0x1p63, 0x1p62);
    unit.input("large", unit.large).max(0x1p63);
  }));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("small", unit.small).max(128); }),
                    "variable 'small': the bound 128 is not a value of the type Int8");
  CHECK_THROWS(check([](Rows& unit) { unit.input("small", unit.small).min(-129); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("small", unit.small).max(0.5); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("natural", unit.natural).min(-1); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("integer", unit.integer).max(0x1p63); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("large", unit.large).max(0x1p64); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("narrow", unit.narrow).max(1e300); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("real", unit.real).max(kInfinity); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("real", unit.real).min(std::nan("")); }));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("real", unit.real).range(1, 0); }),
                    Contains("the minimum 1 is above the maximum 0"));
}

TEST_CASE("the items of an Enumeration are enumerators of the unit, or numbers") {
  enum class Mode : std::int64_t { Eco = 1, Sport = 5 };
  Mode mode = Mode::Eco;
  const std::vector<std::pair<std::string, std::int64_t>> listed{{"eco", 1}, {"sport", 5}};
  const auto items = [&](const std::function<void(VariableBuilder)>& list) {
    const Rows unit([&](Rows& rows) { list(rows.input("mode", mode)); });
    return unit.variables().at(0).items;
  };
  CHECK(items([](VariableBuilder row) {
          row.items({{"eco", Mode::Eco}, {"sport", Mode::Sport}});
        }) == listed);
  CHECK(items([](VariableBuilder row) { row.items({{"eco", 1}, {"sport", 5}}); }) == listed);
  CHECK(items([&](VariableBuilder row) { row.items(listed); }) == listed);
  CHECK(items([](VariableBuilder row) { row.items({{"eco", Mode::Eco}}); }).size() == 1);
}

TEST_CASE("types without an order have no bounds") {
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("flag", unit.flag).max(1); }),
                    "variable 'flag': the type Boolean has no bounds");
  CHECK_THROWS(check([](Rows& unit) { unit.input("text", unit.text).min(0); }));
  CHECK_THROWS(check([](Rows& unit) { unit.input("bytes", unit.bytes).min(0); }));
  CHECK_THROWS(check([](Rows& unit) { unit.output("clock", unit.clock).min(0); }));
}

TEST_CASE("a clock depends on nothing of its own instant, so it declares no dependencies") {
  CHECK_NOTHROW(check([](Rows& unit) { unit.output("clock", unit.clock); }));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.output("clock", unit.clock).depends_on({}); }),
                    Contains("variable 'clock': a clock has no depends_on()"));
}

TEST_CASE("only an input clock ticks by the time, with an interval that can be") {
  using namespace std::chrono_literals;
  CHECK_NOTHROW(check([](Rows& unit) { unit.input("clock", unit.clock).every(Duration(1)); }));
  CHECK_NOTHROW(check([](Rows& unit) { unit.input("clock", unit.clock).every_tunable(); }));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.output("clock", unit.clock).countdown(); }),
                    "variable 'clock': only an input clock can tick by the time");
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("real", unit.real).every(1ms); }),
                    "variable 'real': only an input clock can tick by the time");
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("clock", unit.clock).every(0ms); }),
                    "a clock's interval must be positive");
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("clock", unit.clock).every(1ms, -1ms); }),
                    "a clock's shift must not be negative");
}

TEST_CASE("only a continuous input changes within a step") {
  CHECK_NOTHROW(check([](Rows& unit) { unit.input("real", unit.real).intermediate(); }));
  const std::string reason = "only a continuous input can be intermediate()";
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("flag", unit.flag).intermediate(); }),
                    Contains(reason));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.output("real", unit.real).intermediate(); }),
                    Contains(reason));
}

TEST_CASE("a verdict is one Boolean output, its text one String output") {
  CHECK_NOTHROW(check([](Rows& unit) { unit.output("good", unit.flag).verdict(); }));
  CHECK_NOTHROW(check([](Rows& unit) {
    unit.output("why", unit.text).verdict_text();
    unit.output("good", unit.flag).verdict();
  }));
  CHECK_THROWS_WITH(
      check([](Rows& unit) { unit.input("good", unit.flag).verdict(); }),
      "variable 'good': only a scalar Boolean output without a clock can be a verdict()");
  CHECK_THROWS(check([](Rows& unit) { unit.output("good", unit.natural).verdict(); }));
  CHECK_THROWS(check([](Rows& unit) {
    unit.output("clock", unit.clock);
    unit.output("good", unit.flag).clocked_by(unit.clock).verdict();
  }));
  CHECK_THROWS(check([](Rows& unit) { unit.output("good", unit.flag).dimensions({1}).verdict(); }));
  CHECK_THROWS_WITH(
      check([](Rows& unit) { unit.output("why", unit.flag).verdict_text(); }),
      "variable 'why': only a scalar String output without a clock can be a verdict_text()");
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.output("why", unit.text).verdict_text(); }),
                    Contains("variable 'why': there is no verdict to explain"));
  CHECK_THROWS_WITH(check([](Rows& unit) {
                      unit.output("good", unit.flag).verdict();
                      unit.output("better", unit.other_flag).verdict();
                    }),
                    "variable 'better': 'good' is that already; a unit has one");
}

TEST_CASE("a deadband is of a Float64 input, a tolerance of a Float64 output") {
  const auto check_idle = [](const std::function<void(Rows&)>& list) {
    check([&](Rows& unit) {
      unit.describe("idle now and then").promises_idle = true;
      list(unit);
    });
  };
  CHECK_NOTHROW(check_idle([](Rows& unit) { unit.input("real", unit.real).deadband(0); }));
  CHECK_NOTHROW(check_idle([](Rows& unit) { unit.output("real", unit.real).tolerance(1e-9); }));
  CHECK_THROWS_WITH(check_idle([](Rows& unit) { unit.output("real", unit.real).deadband(1); }),
                    "variable 'real': only a Float64 input has a deadband");
  CHECK_THROWS_WITH(check_idle([](Rows& unit) { unit.input("real", unit.narrow).deadband(1); }),
                    "variable 'real': only a Float64 input has a deadband");
  CHECK_THROWS_WITH(check_idle([](Rows& unit) { unit.input("real", unit.real).tolerance(1); }),
                    "variable 'real': only a Float64 output has a tolerance");
  CHECK_THROWS_WITH(check_idle([](Rows& unit) { unit.output("n", unit.natural).tolerance(1); }),
                    "variable 'n': only a Float64 output has a tolerance");
  CHECK_THROWS_WITH(check_idle([](Rows& unit) { unit.input("real", unit.real).deadband(-1); }),
                    "variable 'real': the deadband is -1, expected at least 0");
  CHECK_THROWS_WITH(check_idle([](Rows& unit) { unit.output("real", unit.real).tolerance(0); }),
                    "variable 'real': the tolerance is 0, expected more than 0");
  CHECK_THROWS(
      check_idle([](Rows& unit) { unit.output("real", unit.real).tolerance(std::nan("")); }));
}

TEST_CASE("a unit that never promises to be idle has neither") {
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.input("real", unit.real).deadband(1); }),
                    Contains("variable 'real'") && Contains("promises_idle"));
  CHECK_THROWS_WITH(check([](Rows& unit) { unit.output("real", unit.real).tolerance(1); }),
                    Contains("variable 'real'") && Contains("promises_idle"));
}
