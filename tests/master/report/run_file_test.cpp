#include "master/report/run_file.h"

#include <fstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/observe/recorders/run_json.h"
#include "tests/master/report/support.h"

using namespace stride;
using namespace stride::report;
using Catch::Contains;

TEST_CASE("run.json comes back as it was written") {
  const TemporaryFolder folder;
  const core::System system = tests::sample_system();
  core::RunOptions options;
  options.recorded = {{0, 1}, {0, 2}, {0, 4}};
  recorders::ResultFiles files;
  files.trace.clear();
  files.events = "messages.csv";
  const std::vector<recorders::Plot> plots = {{"Height", {"a.distance"}}};
  recorders::write_run_json(folder / "run.json", {.scenario = "x.ssd",
                                                  .system = system,
                                                  .options = options,
                                                  .statistics = {},
                                                  .files = files,
                                                  .plots = plots});
  const RunFile run = read_run_file(folder / "run.json");
  CHECK(run.json["outcome"] == "completed");
  CHECK(run.files.events == "messages.csv");
  CHECK(run.files.trace.empty());
  REQUIRE(run.signals.size() == 5);
  CHECK(run.signals[0].name == "a.distance");
  CHECK(run.signals[0].unit == "m");
  CHECK(run.signals[0].is_continuous);
  CHECK(run.signals[1].type == core::ValueType::Boolean);
  CHECK_FALSE(run.signals[1].is_continuous);
  CHECK(run.signals[4].name == "a.position[3]");
  REQUIRE(run.components.size() == 2);
  CHECK(run.components[1].name == "b, c");
  CHECK(run.components[1].model == "Sample");
  CHECK(run.plots == plots);
}

TEST_CASE("a file of an older program has less") {
  const TemporaryFolder folder;
  const RunFile run = read_run_file(folder.write("run.json", R"({"outcome": "completed"})"));
  CHECK(run.signals.empty());
  CHECK(run.files.signals == "signals.csv");
}

TEST_CASE("brackets in texts are not nested, and neither are those behind each other") {
  const TemporaryFolder folder;
  const std::string title = "\\\"" + std::string(100, '[') + "\\\\";
  std::string plots;
  for (int i = 0; i < 100; ++i) {
    plots += (i == 0 ? "" : ",") + fmt::format(R"({{"title": "{}", "signals": []}})", title);
  }
  const RunFile run = read_run_file(folder.write("run.json", "{\"plots\": [" + plots + "]}"));
  REQUIRE(run.plots.size() == 100);
  CHECK(run.plots[0].title == "\"" + std::string(100, '[') + "\\");
}

TEST_CASE("what is not a run.json is refused") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    return error_of([&] { read_run_file(folder.write("run.json", text)); });
  };
  const std::string other = "run.json: this is not what `stride run` writes: ";
  CHECK_THAT(refusal("{\n\"a\": 1,\n\"b\""),
             Contains("run.json:3: this is not JSON, in column 3: the text ends too early"));
  CHECK_THAT(refusal(""), Contains("run.json:1: this is not JSON: the file is empty"));
  CHECK_THAT(refusal("[]"), Contains(other + "its root is of the type array, expected an object"));
  CHECK_THAT(refusal(R"({"signals": [{"name": 1}]})"),
             Contains(other + "'signals[0].name' is of the type number, expected a text"));
  CHECK_THAT(refusal(R"({"plots": 3})"),
             Contains(other + "'plots' is of the type number, expected a list"));
  CHECK_THAT(refusal(R"({"units": [{"name": "a"}]})"),
             Contains(other + "'units[0].model' is missing"));
  CHECK_THAT(refusal(R"({"plots": [{"title": "x", "signals": ["a", 3]}]})"),
             Contains(other + "'plots[0].signals[1]' is of the type number, expected a text"));
  CHECK_THAT(refusal(R"({"files": []})"), Contains(other + "'files' is of the type array"));
  CHECK_THAT(refusal(R"({"files": {"signals": "../x"}})"),
             Contains("'../x' is not a file of this"));
  CHECK_THAT(refusal(R"({"stop": 1e999})"), Contains(other + "a number in it is out of range"));
  for (const char* text : {"", "{\"a\":\xff}", "{\"a\": 1e999}", "{\"signals\": 1}", "[1"}) {
    CHECK_THAT(refusal(text), !Contains("json.exception") && !Contains("parse_error"));
  }
  CHECK_THAT(refusal("{\"a\":" + std::string(100'000, '[')), Contains("nested too deeply"));
  CHECK_THAT(error_of([&] { read_run_file(folder / "none.json"); }),
             Contains("none.json: the file does not exist"));
}

TEST_CASE("a run file is found under another name, by its content") {
  const TemporaryFolder folder;
  CHECK(find_run_file(folder / "").empty());
  folder.write("a.json", R"({"files": {"statistics": "other.json"}})");
  folder.write("b.json", "no JSON");
  folder.write("stats.json", R"({"files": {"statistics": "stats.json"}})");
  CHECK(find_run_file(folder / "").filename() == "stats.json");
  folder.write("run.json", "{}");
  CHECK(find_run_file(folder / "").filename() == "run.json");
}

TEST_CASE("what is too large to be one is not read") {
  const TemporaryFolder folder;
  const auto file = folder.write("a.json", R"({"files": {"statistics": "a.json"}})");
  REQUIRE(find_run_file(folder / "") == file);
  std::ofstream padded(file, std::ios::app);
  for (int i = 0; i < 64; ++i) padded << std::string(std::size_t{1} << 20, ' ');
  padded.close();
  CHECK(find_run_file(folder / "").empty());
  CHECK_THAT(error_of([&] { read_run_file(file); }),
             Contains("a.json: the file has more than 67108864 bytes"));
}
