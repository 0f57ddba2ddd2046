#include <cstdint>
#include <random>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/counted.h"
#include "master/base/text/readable_text.h"
#include "master/base/time_text.h"
#include "master/engine/port/capabilities/message_text.h"
#include "master/study/verify/checks.h"

namespace stride::verify {
namespace {

using core::Binary;
using core::ValueType;
using core::Variable;

constexpr std::size_t kValues = 500;  // of each variable, at each instant
constexpr std::size_t kLongest = 300;
constexpr std::size_t kHuge = std::size_t{1} << 20;

std::vector<const Variable*> binaries(const core::UnitDescription& unit) {
  std::vector<const Variable*> found;
  for (const Variable& variable : unit.variables) {
    if (variable.type == ValueType::Binary) found.push_back(&variable);
  }
  return found;
}

/// Requests the text of values from a unit, of those that it has and of any others.
class TextQueries {
 public:
  explicit TextQueries(const Trial& trial)
      : variables_(binaries(trial.tested.description())), random_(trial.tested.request().seed) {}

  void query(TestInstance& instance) {
    for (const Variable* variable : variables_) {
      for (std::size_t i = 0; i < kValues; ++i)
        query(instance, *variable, value(random_() % kLongest));
      query(instance, *variable, {});
      query(instance, *variable, value(kHuge));
    }
  }

  std::size_t variables() const { return variables_.size(); }
  std::size_t values() const { return values_; }
  std::size_t texts() const { return texts_; }

 private:
  /// Random bytes, of all kinds or small ones, which numbers and letters are more often.
  Binary value(std::size_t size) {
    const std::uint64_t mask = random_() % 2 == 0 ? 0xFF : 0x7;
    Binary bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random_() & mask);
    return bytes;
  }

  void query(TestInstance& instance, const Variable& variable, const Binary& value) {
    auto& unit = instance.capability<core::MessageText>();
    const std::string text = unit.describe_message(variable.reference, value);
    const std::string what =
        fmt::format("the description of {} as '{}' at {} s", core::counted(value.size(), "byte"),
                    variable.name, core::to_text(instance.now()));
    if (!core::is_readable(text)) {
      throw Failure(what + " is not one line of UTF-8 without control characters: \"" +
                    core::readable_text(text, 60) + '"');
    }
    if (unit.describe_message(variable.reference, value) != text) {
      throw Failure(what + " differs when it is requested again: \"" +
                    core::readable_text(text, 60) + '"');
    }
    ++values_;
    if (!text.empty()) ++texts_;
  }

  std::vector<const Variable*> variables_;
  std::mt19937_64 random_;
  std::size_t values_ = 0;
  std::size_t texts_ = 0;
};

}  // namespace

Finding check_messages(const Trial& trial) {
  TextQueries queries(trial);
  if (queries.variables() == 0) return skipped("it has no Binary variable");
  const Recording expected = trial.record();
  const auto library = trial.tested.fmu().load_fmi3_library();
  if (library == nullptr || library->describe_functions().DescribeMessage == nullptr) {
    return skipped("its library does not export strideDescribeMessage");
  }
  TestInstance instance = trial.make_instance();
  queries.query(instance);
  instance.start();
  for (const double share : {0.0, 0.3, 0.7, 1.0}) {
    instance.run_to(trial.point_at(share));
    queries.query(instance);
  }
  if (const auto differs = difference(trial.tested, expected.rows, instance.recording().rows,
                                      "in an instance without requests for message descriptions",
                                      "in one with them")) {
    throw Failure(*differs);
  }
  instance.terminate();
  queries.query(instance);
  return passed(fmt::format("{} of {} of {} have words; asking for them changes nothing",
                            queries.texts(), core::counted(queries.values(), "value"),
                            core::counted(queries.variables(), "Binary variable")));
}

}  // namespace stride::verify
