// What the distance of a machine costs (docs/remote.md): its messages are counted on the way.
#include <chrono>
#include <map>
#include <optional>
#include <string>

#include <nlohmann/json.hpp>

#include "master/loader/network/message.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
namespace remote = stride::remote;

namespace {

/// Carries bytes between its own pipes and those of a command, each way in half of a delay [s] or
/// later, and keeps them in the files `requests` and `replies`.
constexpr const char* kRelay = R"(
import os, queue, subprocess, sys, threading, time
delay = float(sys.argv[1]) / 2
child = subprocess.Popen(sys.argv[2:], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
def carry(source, target, name):
    waiting = queue.Queue()
    def read():
        while data := os.read(source, 65536):
            waiting.put((time.monotonic() + delay, data))
        waiting.put((0, b""))
    threading.Thread(target=read, daemon=True).start()
    with open(name, "wb", buffering=0) as kept:
        while True:
            due, data = waiting.get()
            time.sleep(max(0, due - time.monotonic()))
            kept.write(data)
            if not data:
                os.close(target)
                return
            while data:
                data = data[os.write(target, data):]
threading.Thread(target=carry, args=(0, child.stdin.fileno(), "requests"), daemon=True).start()
carry(child.stdout.fileno(), 1, "replies")
)";

/// Round trips of a unit's end, which comes when run.json is written: statistics, end, files.
constexpr std::uint64_t kBehindRunJson = 3;

/// Calls take(Head) for each message after the greeting.
template <class Head, class Take>
void read_messages(const fs::path& file, Take&& take) {
  const std::string bytes = read(file);
  remote::FrameReader reader;
  reader.put(std::string_view(bytes).substr(bytes.find('\n') + 1));
  while (const auto message = reader.next()) take(remote::Message<Head>(*message).head);
}

/// A run whose second unit is behind the relay.
struct Course {
  std::map<remote::RequestCode, std::uint64_t> awaited;  ///< requests, by their kind
  std::uint64_t all_awaited = 0, answers = 0;
  nlohmann::json unit;   ///< its entry in run.json
  double wall_time = 0;  ///< of all [s]
  std::string signals;

  const nlohmann::json& link() const { return unit["host"]["link"]; }
};

Parts behind_relay(Parts parts, const std::string& delay) {
  parts.annotation = "<stride:Host components='second' at='exec:exec python3 relay.py " + delay +
                     " " + stride_program().string() + " serve'/>\n";
  return parts;
}

Course run_behind_relay(const Parts& parts, const std::string& delay, const std::string& stop) {
  using Clock = std::chrono::steady_clock;
  const Workspace workspace(behind_relay(parts, delay));
  workspace.scratch().write("relay.py", kRelay);
  const auto begin = Clock::now();
  const Outcome outcome = workspace.run({"--stop", stop, "--quiet"});
  Course course;
  course.wall_time = std::chrono::duration<double>(Clock::now() - begin).count();
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  read_messages<remote::RequestHead>(workspace / "requests", [&](const remote::RequestHead& head) {
    if (head.is_awaited != 0) ++course.awaited[head.request];
  });
  for (const auto& [kind, count] : course.awaited) course.all_awaited += count;
  read_messages<remote::ReplyHead>(workspace / "replies", [&](const remote::ReplyHead& head) {
    course.answers += head.code == remote::ReplyCode::Done ? 1 : 0;
  });
  course.unit = nlohmann::json::parse(workspace.result("run.json"))["units"][1];
  course.signals = workspace.result("signals.csv");
  return course;
}

}  // namespace

TEST_CASE("a step of a unit elsewhere is one round trip, however long that takes") {
  const Workspace near(two_filters());
  REQUIRE(near.run({"--stop", "0.05", "--quiet"}).exit_code == 0);
  std::optional<Course> quick;
  for (const std::string delay : {"0", "0.001", "0.02"}) {
    INFO(delay);
    const Course course = run_behind_relay(two_filters(), delay, "0.05");
    CHECK(course.signals == near.result("signals.csv"));
    CHECK(course.awaited.at(remote::RequestCode::Step) == 50);
    CHECK(course.answers == course.all_awaited);
    CHECK(course.link()["round_trips"] == course.all_awaited - kBehindRunJson);
    if (!quick) quick = course;
    CHECK(course.awaited == quick->awaited);
    // a time has no limit from above but another one that was measured
    const double lost = course.link()["lost_time"];
    CHECK(course.wall_time >= std::stod(delay) * static_cast<double>(course.all_awaited));
    CHECK(lost > 0);
    CHECK(lost <= course.wall_time);
  }
  const Course longer = run_behind_relay(two_filters(), "0", "0.15");
  CHECK(longer.all_awaited == quick->all_awaited + 100);
}

TEST_CASE("an event of a unit elsewhere is a round trip, and one for each type that is read") {
  constexpr std::uint64_t kTypes = 3;  // Float64, Int64, Clock
  // instantiation, initialization, statistics three times, termination, end, files
  constexpr std::uint64_t kLifeCycle = 9;
  const Parts tickers{component("first", "ticker.fmu") + component("second", "ticker.fmu"), ""};
  for (const std::string stop : {"0.05", "0.15"}) {
    const Course course = run_behind_relay(tickers, "0", stop);
    const std::uint64_t steps = course.unit["steps"], events = course.unit["events"];
    CHECK(events > 30);
    CHECK(course.awaited.at(remote::RequestCode::Step) == steps);
    CHECK(course.all_awaited == kLifeCycle + steps + (1 + kTypes) * events);
    CHECK(course.link()["round_trips"] == course.all_awaited - kBehindRunJson);
  }
}
