// A run that is killed goes on from its last checkpoint.
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/build.h"
#include "tests/cli/course.h"

using namespace stride::tests;
using namespace std::chrono_literals;

namespace {

/// The second process of a run that was killed may still be about to end, with its lock.
Outcome resume_unlocked(const Workspace& workspace, const Arguments& arguments) {
  for (int tries = 0;; ++tries) {
    Outcome outcome = workspace.stride(arguments);
    const bool is_locked = outcome.err.find("has locked this folder") != std::string::npos;
    if (!is_locked || tries == 100) return outcome;
    std::this_thread::sleep_for(20ms);
  }
}

}  // namespace

TEST_CASE("a run that is killed at any instant goes on to the same results") {
  Parts parts{component("ticker", "ticker.fmu") + component("listener", "listener.fmu"),
              connection("ticker.tick.clock", "listener.message.clock") +
                  connection("ticker.tick.number", "listener.message.number") +
                  connection("ticker.tick.picoseconds", "listener.message.picoseconds"),
              ""};
  parts.experiment = "<ssd:DefaultExperiment stopTime=\"8\"/>\n";
  const Workspace whole(parts);
  const Arguments options{"--quiet", "--checkpoint-every", "1"};
  const auto began = std::chrono::steady_clock::now();
  REQUIRE(whole.run(options).exit_code == 0);
  const auto length = std::chrono::steady_clock::now() - began;
  const Workspace cut(parts);
  std::mt19937 random(7);
  const int kills = kSanitized ? 8 : 40;
  int resumed = 0;
  for (int i = 0; i < kills; ++i) {
    fs::remove_all(cut / "out");
    {
      Process process(stride_command(Workspace::run_arguments(options)), cut.scratch().path());
      std::this_thread::sleep_for(length * (random() % 1000) / 1000);
      process.send(SIGKILL);
      process.wait();
    }
    if (!fs::exists(cut / "out/checkpoints") || fs::is_empty(cut / "out/checkpoints")) continue;
    const Outcome outcome = resume_unlocked(cut, {"resume", "out", "--quiet"});
    INFO(outcome.err);
    if (outcome.exit_code == 2 && outcome.err.find("no checkpoint in") != std::string::npos) {
      continue;  // killed in the first one
    }
    REQUIRE(outcome.exit_code == 0);
    check_same_traces(whole / "out", cut / "out");
    ++resumed;
  }
  CHECK(resumed > kills / 4);
}
