#include "master/observe/recorders/run_json.h"

#include <catch2/catch.hpp>

#include "tests/master/system/ssp/support.h"

using namespace stride;
using namespace stride::core;
using namespace stride::recorders;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

core::Verdict check() {
  core::Verdict verdict{"near", true, "it was so", "always", {"x.ssd", 7}};
  verdict.margin = {0.25, "m", Time(1500ms)};
  core::ValueBlock most(core::ValueType::Float64, 1);
  most.numbers<double>()[0] = 2.5;
  verdict.limits = {"a.distance", Time(1s), {}, {{"max", most}}};
  return verdict;
}

/// The sample system with a connection.
core::System wired_system() {
  auto description = sample_description();
  description->variables.push_back(
      variable("warmth", 13, core::ValueType::Float64, core::Causality::Output, "degC"));
  core::SystemDeclaration declaration;
  declaration.name = "sample";
  declaration.components = {{"a", description, {}, {}}, {"b, c", description, {}, {}}};
  declaration.connections = {{"a", "warmth", "b, c", "temperature", false, {}}};
  return core::System(declaration);
}

/// run.json of this much of a run of the sample system.
std::string written(const core::RunStatistics& statistics, std::optional<std::string> error = {}) {
  const TemporaryFolder folder;
  const core::System system = sample_system();
  write_run_json(folder / "run.json", {.scenario = "x.ssd",
                                       .system = system,
                                       .options = {},
                                       .statistics = statistics,
                                       .error = std::move(error)});
  return content(folder / "run.json");
}

}  // namespace

TEST_CASE("run.json has what was run and how far the run came") {
  const TemporaryFolder folder;
  core::RunOptions options;
  options.stop = Time(14'200ms);
  options.step.size = 1ms;
  options.threads.count = 4;
  core::RunStatistics statistics;
  statistics.reached = options.stop;
  statistics.communication_steps = 14'200;
  statistics.event_iterations = 3;
  statistics.parallel_steps = 14'000;
  statistics.wall_time = 250ms;
  statistics.measured_steps = 300;
  statistics.phases = {10ms, 200ms, 30ms, 5ms};
  statistics.phase_uncertainties.steps = 10ms;
  statistics.units = {
      {71'000,
       14'200,
       5,
       3,
       8,
       14'190,
       12,
       {},
       2,
       0,
       4,
       2500ms,
       1000ms,
       1,
       0,
       1ms,
       2ms,
       3ms,
       500us},
      {0, 14'201, 0, 0, 0, 0, 0, {}, 0, 0, 0, {}, {}, 0, 1, 0ms, 0ms, 0ms},
  };
  core::HostStatistics& host = statistics.units[1].host.emplace();
  host.most_memory = 4096;
  host.protections = {"no network", "seccomp"};
  host.missing_protections = {"landlock"};
  const std::vector<core::Verdict> verdicts = {{"b, c", false, "too \"late\""}, check()};
  options.recorded = {{0, 1}, {1, 4}};
  const std::vector<Plot> plots = {{"Height", {"a.distance"}}};
  const std::vector<CoverageSummary> coverage = {{"a", 62.5, {}}, {"b, c", {}, 90.0}};
  ResultFiles files;
  files.trace.clear();
  const core::System system = wired_system();
  write_run_json(folder / "run.json", {.scenario = "scenarios/x.ssd",
                                       .system = system,
                                       .options = options,
                                       .provenance = {.version = "1",
                                                      .date = "2026-01-01T00:00:00Z",
                                                      .host = "desk",
                                                      .commands = {{{"run", "x y.ssd"}, "/w"}},
                                                      .sources = {{"a unit", "/w/a.fmu", "0f"}},
                                                      .swaps = {"b=mine.fmu"}},
                                       .statistics = statistics,
                                       .verdicts = verdicts,
                                       .files = files,
                                       .plots = plots,
                                       .coverage = coverage});
  CHECK(content(folder / "run.json") == R"({
  "scenario": "scenarios/x.ssd",
  "system": "sample",
  "start": 0.0,
  "stop": 14.2,
  "step": {
    "policy": "fixed",
    "size": 0.001,
    "minimum": 1e-09,
    "coupling": "jacobi",
    "extrapolation": "hold"
  },
  "outcome": "completed",
  "verdicts": [
    {
      "component": "b, c",
      "passed": false,
      "text": "too \"late\""
    }
  ],
  "checks": [
    {
      "name": "near",
      "kind": "always",
      "passed": true,
      "text": "it was so",
      "time": null,
      "margin": {
        "value": 0.25,
        "unit": "m",
        "at": 1.5
      },
      "line": 7,
      "values": [],
      "limits": {
        "signal": "a.distance",
        "from": 1.0,
        "to": null,
        "max": 2.5
      }
    }
  ],
  "coverage": [
    {
      "component": "a",
      "percentage": 62.5,
      "goal": null
    },
    {
      "component": "b, c",
      "percentage": null,
      "goal": 90.0
    }
  ],
  "threads": 4,
  "recorded_signals": 2,
  "reached": 14.2,
  "communication_steps": 14200,
  "undone_steps": 0,
  "event_iterations": 3,
  "parallel_steps": 14000,
  "wall_time": 0.25,
  "measured_steps": 300,
  "phases": {
    "initialization": 0.01,
    "steps": 0.2,
    "instants": 0.03,
    "observers": 0.005
  },
  "phase_uncertainties": {
    "initialization": 0.0,
    "steps": 0.01,
    "instants": 0.0,
    "observers": 0.0
  },
  "units": [
    {
      "name": "a",
      "model": "Sample",
      "fmi_version": "3.0",
      "calls": 71000,
      "steps": 14200,
      "early_returns": 5,
      "rejections": 3,
      "rollbacks": 8,
      "saves": 14190,
      "repeated_steps": 12,
      "events": 2,
      "messages_sent": 1,
      "messages_received": 0,
      "idle": {
        "rests": 4,
        "skipped": 2.5,
        "longest": 1.0
      },
      "wall_time": {
        "initialization": 0.001,
        "steps": 0.002,
        "events": 0.003,
        "steps_uncertainty": 0.0005,
        "events_uncertainty": 0.0
      }
    },
    {
      "name": "b, c",
      "model": "Sample",
      "fmi_version": "3.0",
      "calls": 0,
      "steps": 14201,
      "early_returns": 0,
      "rejections": 0,
      "rollbacks": 0,
      "saves": 0,
      "repeated_steps": 0,
      "events": 0,
      "messages_sent": 0,
      "messages_received": 1,
      "wall_time": {
        "initialization": 0.0,
        "steps": 0.0,
        "events": 0.0,
        "steps_uncertainty": 0.0,
        "events_uncertainty": 0.0
      },
      "host": {
        "memory": 4096,
        "protections": [
          "no network",
          "seccomp"
        ],
        "missing_protections": [
          "landlock"
        ]
      }
    }
  ],
  "connections": [
    {
      "from": "a.warmth",
      "to": "b, c.temperature",
      "kind": "value"
    }
  ],
  "interventions": [],
  "files": {
    "signals": "signals.csv",
    "events": "events.csv",
    "activity": "activity.csv",
    "statistics": "run.json",
    "report": "report.html",
    "coverage": "coverage.json"
  },
  "signals": [
    {
      "name": "a.distance",
      "unit": "m",
      "type": "Float64",
      "variability": "continuous"
    },
    {
      "name": "b, c.position[1]",
      "unit": "m",
      "type": "Float64",
      "variability": "continuous"
    },
    {
      "name": "b, c.position[2]",
      "unit": "m",
      "type": "Float64",
      "variability": "continuous"
    },
    {
      "name": "b, c.position[3]",
      "unit": "m",
      "type": "Float64",
      "variability": "continuous"
    }
  ],
  "plots": [
    {
      "title": "Height",
      "signals": [
        "a.distance"
      ]
    }
  ],
  "provenance": {
    "version": "1",
    "date": "2026-01-01T00:00:00Z",
    "host": "desk",
    "commands": [
      {
        "text": "stride run 'x y.ssd'",
        "words": [
          "run",
          "x y.ssd"
        ],
        "folder": "/w"
      }
    ],
    "swaps": [
      "b=mine.fmu"
    ],
    "values": [],
    "sources": [
      {
        "what": "a unit",
        "path": "/w/a.fmu",
        "sha256": "0f"
      }
    ]
  }
}
)");
}

TEST_CASE("An error is recorded, also when the run never began") {
  const std::string text = written({}, "unit 'a': it said \"no\"\xff");
  CHECK_THAT(text,
             Contains("\"outcome\": \"failed\",\n  \"error\": \"unit 'a': it said \\\"no\\\""));
  CHECK_THAT(text, Contains("\"name\": \"b, c\"") && !Contains("messages_sent"));
}

TEST_CASE("An error can be added once, after the run") {
  const TemporaryFolder folder;
  folder.write("run.json", written(core::RunStatistics{}));
  CHECK(add_error(folder / "run.json", "it broke"));
  CHECK_THAT(content(folder / "run.json"),
             Contains("\"outcome\": \"failed\"") && Contains("\"error\": \"it broke\""));
  CHECK_FALSE(add_error(folder / "run.json", "this, too"));
  CHECK_THAT(content(folder / "run.json"), !Contains("this, too"));
}

TEST_CASE("The snapshots of a process are recorded where there were some") {
  core::RunStatistics statistics;
  statistics.units.resize(2);
  core::HostStatistics& host = statistics.units[0].host.emplace();
  host.snapshots = 14;
  host.restores = 3;
  host.most_snapshots = 2;
  host.most_snapshot_memory = 8192;
  CHECK_THAT(written(statistics), Contains(R"(
        "snapshots": {
          "made": 14,
          "restored": 3,
          "most_kept": 2,
          "memory": 8192
        },)"));
}

TEST_CASE("A unit may end the run") {
  core::RunStatistics statistics;
  statistics.end = core::RunEnd::EndedByUnit;
  CHECK_THAT(written(statistics), Contains("\"outcome\": \"ended by a unit\""));
}

TEST_CASE("A full disk is noticed") {
  const core::System system = sample_system();
  CHECK_THROWS_WITH(
      write_run_json("/dev/full",
                     {.scenario = "x.ssd", .system = system, .options = {}, .statistics = {}}),
      Contains("/dev/full: cannot write the file"));
}
