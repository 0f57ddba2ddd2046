#include "master/system/scenario/units/unit_log.h"

#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

namespace stride::scenario {
namespace {

/// What is logged, line by line, with units 'a0', 'a1', … of one FMU and 'b' of another one.
class LogOfUnits {
 public:
  explicit LogOfUnits(spdlog::level::level_enum level = spdlog::level::warn) {
    auto logger = std::make_shared<spdlog::logger>(
        "test", std::make_shared<spdlog::sinks::ostream_sink_st>(text_));
    logger->set_pattern("%v");
    logger->set_level(level);
    spdlog::set_default_logger(logger);
    log_.emplace();
    for (int i = 0; i < 100; ++i) log_->add_unit(fmt::format("a{}", i), "a.fmu");
    log_->add_unit("b", "b.fmu");
  }
  ~LogOfUnits() { spdlog::set_default_logger(before_); }
  LogOfUnits(const LogOfUnits&) = delete;
  LogOfUnits& operator=(const LogOfUnits&) = delete;

  void warn(const std::string& unit, const std::string& message,
            const std::string& category = "stride") {
    log_->write(unit, importer::Status::Warning, category, message);
  }
  /// Ends the log.
  std::vector<std::string> lines() {
    log_.reset();
    std::istringstream text(text_.str());
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

 private:
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
  std::ostringstream text_;
  std::optional<UnitLog> log_;
};

using Lines = std::vector<std::string>;

TEST_CASE("of one kind of message of many instances the first is shown, and the others counted") {
  const std::string category = GENERATE("stride", "logAll");
  LogOfUnits log;
  for (int i = 0; i < 100; ++i) {
    log.warn(fmt::format("a{}", i),
             fmt::format("the step to {} s ended at -{}e-07 s: --isolate=a{}", i * 0.1, i + 1, i),
             category);
  }
  CHECK(
      log.lines() ==
      Lines{"unit 'a0': the step to 0 s ended at -1e-07 s: --isolate=a0",
            "unit 'a0': 99 other instances of its FMU (a1, a10, a11, a12, a13 and 94 more) logged "
            "the same but for numbers, \"the step to 0 s ended at -1e-07 s: --isolate=a0\"; "
            "messages not shown: 99; --verbose shows them"});
}

TEST_CASE("messages of another kind, of another FMU and of the same instance are shown") {
  LogOfUnits log;
  log.warn("a0", "it is 3 degrees too warm");
  log.warn("a0", "it is 4 degrees too warm");
  log.warn("a1", "it is 5 degrees too cold");
  log.warn("b", "it is 6 degrees too warm");
  log.warn("unknown", "it is 7 degrees too warm");
  log.warn("a1", "x1 is NaN");
  log.warn("a2", "x2 is NaN");
  log.warn("a3", "a30 is another unit");
  log.warn("a4", "a40 is another unit");
  CHECK(log.lines() ==
        Lines{"unit 'a0': it is 3 degrees too warm", "unit 'a0': it is 4 degrees too warm",
              "unit 'a1': it is 5 degrees too cold", "unit 'b': it is 6 degrees too warm",
              "unit 'unknown': it is 7 degrees too warm", "unit 'a1': x1 is NaN",
              "unit 'a2': x2 is NaN", "unit 'a3': a30 is another unit",
              "unit 'a4': a40 is another unit"});
}

TEST_CASE("a long message is named by its beginning") {
  LogOfUnits log;
  const std::string words = "one two three four five six seven eight nine ten eleven twelve ";
  log.warn("a0", words + "thirteen fourteen fifteen");
  log.warn("a1", words + "thirteen fourteen fifteen");
  const Lines lines = log.lines();
  REQUIRE(lines.size() == 2);
  CHECK(lines[1] ==
        "unit 'a0': 1 other instance of its FMU (a1) logged the same but for numbers, \"" + words +
            "thirteen fourteen …\"; messages not shown: 1; --verbose shows them");
}

TEST_CASE("where everything is shown nothing is counted") {
  LogOfUnits log(spdlog::level::info);
  for (int i = 0; i < 100; ++i) log.warn(fmt::format("a{}", i), "it is warm");
  CHECK(log.lines().size() == 100);
}

TEST_CASE("a log without end is bounded, whatever is in it") {
  LogOfUnits log;
  for (int i = 0; i < 5000; ++i) {
    std::string word;
    for (int rest = i; rest > 0; rest /= 10) word += static_cast<char>('a' + rest % 10);
    log.warn("a0", word, "logAll");
  }
  CHECK(log.lines().size() == UnitLog::kMostShown + 2);
}

}  // namespace
}  // namespace stride::scenario
