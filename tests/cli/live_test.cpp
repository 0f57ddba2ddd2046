// The report of a run while it goes on, from outside.
#include <chrono>
#include <csignal>
#include <fstream>
#include <iomanip>
#include <set>
#include <sstream>
#include <string>
#include <thread>

#include "master/base/files/descriptor.h"
#include "tests/build.h"
#include "tests/cli/failures.h"
#include "tests/master/front/cli/live_client.h"
#include "tests/master/report/support.h"

using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using nlohmann::json;
using stride::report::data_of;

namespace {

/// A run whose standard error stream is in a file.
class LiveRun {
 public:
  explicit LiveRun(const Workspace& workspace, const Arguments& options)
      : workspace_(workspace),
        process_({"sh", "-c", "exec " + shell_command(options) + " --live 2> errors"},
                 workspace / "") {}

  /// When it is there.
  std::string address() {
    constexpr const char* kMark = "The report while the run goes on: ";
    for (;;) {
      const std::string text = errors();
      const std::size_t at = text.find(kMark);
      if (at != text.npos && text.find('\n', at) != text.npos) {
        const std::size_t begin = at + std::string(kMark).size();
        return text.substr(begin, text.find('\n', begin) - begin);
      }
      if (!process_.is_running()) FAIL("the run has no page: " << text);
      std::this_thread::sleep_for(1ms);
    }
  }

  std::string errors() const {
    std::error_code none;
    return fs::exists(workspace_ / "errors", none) ? read(workspace_ / "errors") : "";
  }
  Process& process() { return process_; }

 private:
  const Workspace& workspace_;
  Process process_;
};

std::string body(const std::string& answer) { return answer.substr(answer.find("\r\n\r\n") + 4); }

std::string page_at(const std::string& address) {
  LiveClient client(port_in(address));
  client.get(address);
  return body(client.receive());
}

/// The inode of the socket that listens at this port, as /proc has it.
std::string listening_socket(std::uint16_t port) {
  std::ifstream table("/proc/net/tcp");
  std::ostringstream wanted;
  wanted << "0100007F:" << std::uppercase << std::hex << std::setw(4) << std::setfill('0') << port;
  for (std::string line; std::getline(table, line);) {
    std::istringstream words(line);
    std::string number, local, remote, state, word, inode;
    words >> number >> local >> remote >> state >> word >> word >> word >> word >> word >> inode;
    if (state == "0A" && local == wanted.str()) return "socket:[" + inode + "]";
  }
  return "";
}

/// The processes that have this file open.
std::set<std::string> users_of(const std::string& file) {
  std::set<std::string> users;
  std::error_code none;
  for (const fs::directory_entry& process : fs::directory_iterator("/proc", none)) {
    for (const fs::directory_entry& open : fs::directory_iterator(process.path() / "fd", none)) {
      if (fs::read_symlink(open.path(), none) == file) {
        users.insert(process.path().filename().string());
      }
    }
  }
  return users;
}

std::size_t rows(const json& report) { return report["rows"].get<std::size_t>(); }

const Arguments kSlowly{"--quiet", "--realtime", "0.4"};

}  // namespace

TEST_CASE("the page has what is recorded so far, and in the end what report.html has") {
  const Workspace workspace(two_filters());
  LiveRun run(workspace, kSlowly);
  const std::string address = run.address();
  LiveClient events(port_in(address));
  events.get(address, "events");
  const std::string first = page_at(address);
  CHECK_THAT(first, Contains("<meta name=\"stride-live\">") &&
                        Contains("content=\"connect-src 'self'; default-src 'none'"));
  const json early = data_of(first);
  CHECK(early["run"]["outcome"] == "running");
  CHECK(early["columns"].size() == 2);
  CHECK(early["notes"].empty());
  CHECK(rows(early) >= 1);
  CHECK(rows(early) < 1001);
  events.receive("event: update\ndata: 3\n\n");
  const json later = data_of(page_at(address));
  CHECK(rows(later) > rows(early));
  CHECK(rows(later) < 1001);
  CHECK_THAT(events.receive(), Contains("event: end\n"));
  const json last = data_of(page_at(address));
  CHECK(last == data_of(workspace.result("report.html")));
  CHECK(rows(last) == 1001);
  CHECK(run.process().wait().exit_code == 0);
  CHECK(run.errors() == "The report while the run goes on: " + address + "\n");
  CHECK_THAT(workspace.result("report.html"),
             !Contains("<meta name=\"stride-live\">") && !Contains("connect-src 'self'"));
}

TEST_CASE("who looks on, and leaves, changes no result") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::vector<std::string> files{"signals.csv", "events.csv", "activity.csv", "signals.vcd"};
  std::vector<std::string> before;
  for (const std::string& file : files) before.push_back(workspace.result(file));
  json run_before = run_json(workspace);
  LiveRun run(workspace, kSlowly);
  const std::string address = run.address();
  for (int i = 0; i < 5; ++i) {
    LiveClient leaving(port_in(address));
    leaving.get(address, i % 2 == 0 ? "" : "events");
  }
  CHECK(run.process().wait().exit_code == 0);
  for (std::size_t i = 0; i < files.size(); ++i) {
    INFO(files[i]);
    CHECK(workspace.result(files[i]) == before[i]);
  }
  json run_after = run_json(workspace);
  CHECK(run_after["outcome"] == "completed");
  CHECK(run_after["communication_steps"] == run_before["communication_steps"]);
  CHECK(run_after["files"] == run_before["files"]);
}

TEST_CASE("what follows --live is the scenario") {
  const Workspace workspace(two_filters());
  const Outcome outcome = workspace.stride({"run", "--live", "test.ssd", "--out", "out", "-q"});
  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  CHECK(fs::exists(workspace / "out/report.html"));
}

TEST_CASE("an interrupted run tells its end, too") {
  const Workspace workspace(two_filters());
  LiveRun run(workspace, {"--quiet", "--realtime", "0.001"});
  const std::string address = run.address();
  LiveClient events(port_in(address));
  events.get(address, "events");
  events.receive("data: 1\n\n");
  run.process().send(SIGINT);
  CHECK_THAT(events.receive(), Contains("event: end\n"));
  CHECK(data_of(page_at(address))["run"]["outcome"] == "interrupted");
  CHECK(run.process().wait().exit_code == 1);
  CHECK_THAT(run.errors(), Contains("the run was interrupted"));
}

TEST_CASE("a run that fails tells its end, too") {
  const Workspace workspace(Parts{component("first", "minimal.fmu"), "",
                                  "<stride:Step size=\"1e-3\"/><stride:Checks><stride:Always "
                                  "name=\"never so\" signal=\"first.y\" max=\"-1\"/>"
                                  "</stride:Checks>"});
  LiveRun run(workspace, kSlowly);
  const std::string address = run.address();
  LiveClient events(port_in(address));
  events.get(address, "events");
  CHECK_THAT(events.receive(), Contains("event: end\n"));
  page_at(address);
  CHECK(run.process().wait().exit_code == 1);
}

TEST_CASE("a run that a unit crashes ends as it does without anybody who looks on") {
  if (kSanitized) return;
  const Workspace workspace(
      Parts{component("filter", "minimal.fmu") + component("faulty", "fmi3_faulty.fmu")});
  const FaultOrder order("segfault", "step", "0.5");
  LiveRun run(workspace, kSlowly);
  const std::string address = run.address();
  LiveClient events(port_in(address));
  events.get(address, "events");
  CHECK_THAT(events.receive(), !Contains("event: end\n"));  // the connection is lost
  CHECK(run.process().wait().exit_code == 1);
  CHECK_THAT(run.errors(), Contains("SIGSEGV"));
  const json run_file = run_json(workspace);
  CHECK(run_file["outcome"] == "failed");
  CHECK(data_of(workspace.result("report.html"))["run"] == run_file);
}

TEST_CASE("a resumed run has a page if it is asked for, and not because the first one had") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet", "--checkpoint", "0.5", "--live"}).exit_code == 0);
  const Outcome outcome = workspace.stride({"resume", "out", "--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  const Outcome live = workspace.stride({"resume", "out", "--quiet", "--live"});
  CHECK(live.exit_code == 0);
  CHECK_THAT(live.err, Contains("The report while the run goes on: http://127.0.0.1:"));
}

TEST_CASE("units' processes have nothing of the server") {
  const Workspace workspace(two_filters());
  LiveRun run(workspace, {"--quiet", "--realtime", "0.001", "--isolate=first"});
  const std::string address = run.address();
  const std::string socket = listening_socket(port_in(address));
  REQUIRE(socket != "");
  CHECK(users_of(socket).size() == 1);
  run.process().send(SIGINT);
  CHECK(run.process().wait().exit_code == 1);
}

TEST_CASE("a page that cannot be served is a wrong input, and the results stay") {
  const Workspace workspace(two_filters());
  REQUIRE(workspace.run({"--quiet"}).exit_code == 0);
  const std::string before = workspace.result("report.html");
  const stride::core::Descriptor taken(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  REQUIRE(::bind(taken.number(), reinterpret_cast<sockaddr*>(&address), size) == 0);
  REQUIRE(::listen(taken.number(), 1) == 0);
  REQUIRE(::getsockname(taken.number(), reinterpret_cast<sockaddr*>(&address), &size) == 0);
  const std::string port = "--live=" + std::to_string(ntohs(address.sin_port));
  const auto refused = [&](const Arguments& options) {
    const Outcome outcome = workspace.run(options);
    CHECK(outcome.exit_code == 2);
    CHECK(workspace.result("report.html") == before);
    return outcome.err;
  };
  CHECK_THAT(refused({port}), Contains(port + ": this port cannot be had"));
  CHECK_THAT(refused({"--live=http"}), Contains("--live=http: expected the number of a port"));
  CHECK_THAT(refused({"--live", "--no-report"}), Contains("--live: this run writes no report"));
  CHECK_THAT(refused({"--live", "--check-idle"}),
             Contains("--check-idle and --live exclude each other"));
  CHECK_THAT(refused({"--live", "--branch", "0.5:futures.xml"}),
             Contains("--branch and --live exclude each other"));
}
