// Units in processes of their own step at the same time, in whole runs: results and errors are
// those of units that step one after another.
#include <chrono>
#include <functional>
#include <map>
#include <vector>

#include "master/engine/run/simulation.h"
#include "tests/build.h"
#include "tests/master/loader/process/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;

namespace {

constexpr Duration kStep = 1ms;

/// Hosted units that are not wired.
class HostedSystem {
 public:
  using Values = std::vector<std::pair<std::string, std::string>>;

  core::RunOptions options;
  importer::InstanceOptions instance{.debug_logging = true};
  std::vector<std::string> log;
  std::vector<core::UnitStatistics> statistics;

  HostedSystem& add(const std::string& name, const std::string& unit,
                    const isolation::HostOptions& host, const Values& values = {}) {
    fmus_.push_back(importer::Fmu::load(test_fmu(unit)));
    declaration_.components.push_back({name, fmus_.back()->description(), {}, {}});
    for (const auto& [variable, value] : values) {
      declaration_.start_values.push_back({name, variable, value, "", {}});
    }
    hosts_.push_back(host);
    return *this;
  }
  /// Ten steps.
  void run() {
    const core::System system(declaration_);
    instance.log = [this](const std::string& name, importer::Status, const std::string&,
                          const std::string& text) { log.push_back(name + ": " + text); };
    std::vector<std::unique_ptr<core::Unit>> units;
    for (std::size_t i = 0; i < hosts_.size(); ++i) {
      units.push_back(
          isolation::instantiate(fmus_[i], system.components()[i].name, instance, hosts_[i]));
    }
    options.step.size = kStep;
    options.stop = Time(10 * kStep);
    core::Simulation simulation(system, std::move(units), options);
    simulation.run();
    statistics = simulation.statistics().units;
  }
  std::string error() {
    return run_error([&] { run(); });
  }
  bool has_logged(const std::string& part) const {
    return std::ranges::any_of(
        log, [&](const std::string& line) { return line.find(part) != std::string::npos; });
  }

 private:
  core::SystemDeclaration declaration_;
  std::vector<std::shared_ptr<importer::Fmu>> fmus_;
  std::vector<isolation::HostOptions> hosts_;
};

HostedSystem::Values faulty_from(const std::string& at, const std::string& fault) {
  return {{"at", at}, {"fault", fault}};
}

}  // namespace

TEST_CASE("the units of a stage are in their steps at the same time") {
  const Scratch scratch;
  const std::string folder = (scratch / ".").string();
  HostedSystem system;
  const isolation::HostOptions open{.is_sandboxed = false};  // both use one folder
  system.add("a", "meeting", open, {{"folder", folder}, {"other", "b"}});
  system.add("b", "meeting", open, {{"folder", folder}, {"other", "a"}});
  system.options.threads = GENERATE(core::ThreadOptions{}, core::ThreadOptions{2, {}, true});
  CHECK_NOTHROW(system.run());
}

TEST_CASE("of two units that fail in one step the first is reported") {
  const auto [first, second] = GENERATE(table<std::string, std::string>({
      {"segfault", "abort"}, {"exit", "segfault"}, {"abort", "print"},  // not at all
  }));
  CAPTURE(first, second);
  const Belongings before;
  {
    HostedSystem system;
    system.add("well", "faulty", {}).add("u", "faulty", {}, faulty_from("0.004", first));
    system.add("v", "faulty", {}, faulty_from("0.004", second));
    CHECK_THAT(system.error(), Contains("unit 'u', at 0.003 s: ") && Contains("fmi3DoStep"));
  }
  CHECK(Belongings() == before);
}

TEST_CASE("a unit that fails in an earlier step is reported, wherever it is in the file") {
  HostedSystem system;
  system.add("u", "faulty", {}, faulty_from("0.005", "abort"));
  system.add("v", "faulty", {}, faulty_from("0.004", "abort"));
  CHECK_THAT(system.error(), Contains("unit 'v', at 0.003 s: "));
}

TEST_CASE("a unit that hangs ends at its own limit, while another one crashes") {
  const isolation::HostOptions limited{.call_limit = 300ms};
  const Belongings before;
  SECTION("the one that hangs comes first") {
    HostedSystem system;
    system.add("u", "faulty", limited, faulty_from("0.004", "loop"));
    system.add("v", "faulty", limited, faulty_from("0.004", "abort"));
    CHECK_THAT(system.error(), Contains("unit 'u', at 0.003 s: it took longer than 0.3 s"));
  }
  SECTION("the one that crashes comes first") {
    HostedSystem system;
    system.add("u", "faulty", limited, faulty_from("0.004", "abort"));
    system.add("v", "faulty", limited, faulty_from("0.004", "loop"));
    CHECK_THAT(system.error(), Contains("unit 'u', at 0.003 s: its process was ended by signal 6"));
    CHECK(system.has_logged("v: its step was dropped, since another unit had failed: "));
  }
  SECTION("both hang") {
    HostedSystem system;
    system.add("u", "faulty", limited, faulty_from("0.004", "loop"));
    system.add("v", "faulty", limited, faulty_from("0.004", "loop"));
    CHECK_THAT(system.error(), Contains("unit 'u', at 0.003 s: it took longer than 0.3 s"));
  }
  CHECK(Belongings() == before);
}

TEST_CASE("a unit without a limit that hangs does not keep the run from failing") {
  const Belongings before;
  {
    HostedSystem system;
    system.instance.warn_after = 100ms;
    system.add("u", "faulty", {}, faulty_from("0.004", "abort"));
    system.add("v", "faulty", {}, faulty_from("0.004", "loop"));
    CHECK_THAT(system.error(), Contains("unit 'u', at 0.003 s: its process was ended by signal 6"));
    CHECK(system.has_logged("v: its step was dropped, since another unit had failed: "));
    CHECK(system.has_logged("it took longer than 0.1 s in fmi3DoStep"));
  }
  CHECK(Belongings() == before);
}

TEST_CASE("the limit of a unit does not count what the units before it take") {
  HostedSystem system;
  system.add("u", "faulty", {}, faulty_from("0.004", "doze"));  // for a second
  system.add("v", "faulty", {.call_limit = 500ms});
  CHECK_NOTHROW(system.run());
}

TEST_CASE("a unit whose messages have no room until others are done has its time afterwards") {
  HostedSystem system;
  system.add("u", "faulty", {}, faulty_from("0.004", "doze"));  // for a second
  system.add("v", "meeting", {.call_limit = 500ms}, {{"message", "1000000"}});
  CHECK_NOTHROW(system.run());
  CHECK(system.has_logged(std::string(1'000'000, 'x')));
}

TEST_CASE("the times of units that step at the same time are their own") {
  HostedSystem system;  // whose first step is measured in each run
  system.add("u", "faulty", {}, faulty_from("0.001", "doze"));
  system.add("v", "faulty", {}).add("w", "faulty", {}, faulty_from("0.001", "doze"));
  system.run();
  CHECK(system.statistics[0].step_time >= 1s);
  CHECK(system.statistics[2].step_time >= 1s);
  CHECK(system.statistics[1].step_time < system.statistics[0].step_time);
}
