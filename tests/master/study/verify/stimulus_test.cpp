#include "master/study/verify/stimulus.h"

#include <cmath>

#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::verify;
using core::ValueBlock;
using core::ValueType;
using core::Variable;

namespace {

TestedUnit types(const std::vector<std::string>& settings = {}) {
  return TestedUnit(VerifyRequest{.file = tests::test_fmu("types"), .settings = settings});
}

std::string name_of(const TestedUnit& tested, const Stimulus::Input& input) {
  return tested.description().variables[input.variable].name;
}

Variable variable(ValueType type, const std::string& min, const std::string& max) {
  Variable made;
  made.type = type;
  made.min = min;
  made.max = max;
  return made;
}

template <class T>
T other(const Variable& of, T start) {
  ValueBlock block(of.type, 1);
  block.template numbers<T>()[0] = start;
  return other_value(of, block).template numbers<T>()[0];
}

}  // namespace

TEST_CASE("another value is within min and max") {
  CHECK(other(variable(ValueType::Int32, "", ""), 5) == 6);
  CHECK(other(variable(ValueType::Int32, "0", "5"), 5) == 4);
  CHECK(other(variable(ValueType::Int32, "5", "5"), 5) == 5);
  CHECK(other<std::uint8_t>(variable(ValueType::UInt8, "", ""), 255) == 254);
  CHECK(other(variable(ValueType::Boolean, "", ""), true) == false);
  CHECK(other(variable(ValueType::Float64, "", ""), 0.0) == 1);
  CHECK(other(variable(ValueType::Float64, "", "0.5"), 0.0) == 0.25);
  CHECK(other(variable(ValueType::Float64, "-3", "0"), 0.0) == -1);
  CHECK(other(variable(ValueType::Float64, "", ""), -8.0) == -6);
  Variable colour = variable(ValueType::Enumeration, "", "");
  colour.items = {{"red", 1}, {"blue", 4}};
  CHECK(other<std::int64_t>(colour, 1) == 4);
  CHECK(other<std::int64_t>(colour, 4) == 1);
}

TEST_CASE("each number gets a course, texts and bytes and what the user has set do not") {
  const TestedUnit tested = types({"int8=3"});
  const Stimulus stimulus(tested, 1);
  std::vector<std::string> names;
  for (const auto& input : stimulus.inputs()) names.push_back(name_of(tested, input));
  const auto has = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const char* name : {"float32", "float64", "uint64", "boolean", "colour", "matrix"}) {
    CAPTURE(name);
    CHECK(has(name));
  }
  for (const char* name : {"int8", "string", "binary", "receive.frame", "float64.echo", "gain"}) {
    CAPTURE(name);
    CHECK_FALSE(has(name));
  }
}

TEST_CASE("a course begins at the start value, is smooth where it is continuous, and changes") {
  const TestedUnit tested = types();
  const Stimulus stimulus(tested, 1);
  for (const auto& input : stimulus.inputs()) {
    CAPTURE(name_of(tested, input));
    CHECK(stimulus.value(input, 0) == input.start);
    bool changes = false;
    for (std::size_t k = 1; k < 100; ++k) {
      const ValueBlock before = stimulus.value(input, k - 1);
      const ValueBlock now = stimulus.value(input, k);
      changes = changes || before != now;
      if (!input.is_continuous) {
        if (before != now) CHECK(stimulus.changes_at(k));
        continue;
      }
      const double way = std::abs(core::real(input.other, 0) - core::real(input.start, 0));
      CHECK(std::abs(core::real(now, 0) - core::real(before, 0)) < 0.2 * way);
    }
    CHECK(changes);
  }
}

TEST_CASE("the same seed is the same course, another seed another one") {
  const TestedUnit tested = types();
  const Stimulus one(tested, 1);
  const Stimulus same(tested, 1);
  const Stimulus another(tested, 2);
  bool differs = false;
  for (std::size_t i = 0; i < one.inputs().size(); ++i) {
    for (std::size_t k = 0; k < 50; ++k) {
      CHECK(one.value(one.inputs()[i], k) == same.value(same.inputs()[i], k));
      differs = differs || one.value(one.inputs()[i], k) != another.value(another.inputs()[i], k);
    }
  }
  CHECK(differs);
}
