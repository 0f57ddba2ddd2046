#include "master/report/report.h"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "master/report/page.h"
#include "tests/at.h"
#include "tests/master/report/support.h"

using namespace stride;
using namespace stride::report;
using Catch::Contains;
using core::ValueType;
using nlohmann::json;
using recorders::Plot;
using stride::tests::at_picosecond;
using stride::tests::at_picoseconds;

namespace {

Column column(const SignalInfo& info, const std::vector<std::string>& fields) {
  Column made(info);
  for (const std::string& field : fields) made.append({field, false});
  return made;
}

/// Of a run with one of everything.
Results sample(const TemporaryFolder& folder) {
  Results results;
  results.run.json = {{"outcome", "completed"}, {"error", "</script>"}};
  results.run.components = {{"a", "A"}, {"b", "B"}};
  results.run.connections = {{"a.x", "b.u", "value"}};
  results.notes = {"something is missing"};
  results.signals.times = at_picoseconds({0, 1});
  results.signals.columns = {
      column({"a.x", "m", ValueType::Float64, true}, {"nan", "-inf"}),
      column({"a.<n>", "", ValueType::Int64, false}, {"9007199254740993", "1"}),
      column({"a.on", "", ValueType::Boolean, false}, {"true", "false"})};
  results.messages = {
      {at_picosecond(14'200'358'702'064), 1, "a", "y", "sent", "00e8", "</script><!--\xff"}};
  results.activities = {{"a", "idle", at_picoseconds({0, 5}), at_picoseconds({4, 9})}};
  folder.write("0.jpg", "zero");
  folder.write("1.png", "one");
  results.folder = folder / "";
  results.films = {{"world", at_picoseconds({0, 7}), {"0.jpg", "1.png"}}};
  return results;
}

json written(const TemporaryFolder& folder, const Results& results) {
  write_report(folder / "report.html", results, "1.2.3");
  return data_of(content(folder / "report.html"));
}

Column column(const std::string& name, const std::string& unit,
              ValueType type = ValueType::Float64) {
  return Column(SignalInfo{name, unit, type, true});
}

}  // namespace

TEST_CASE("the page has the data in place of its mark, and all else as it is") {
  const TemporaryFolder folder;
  written(folder, sample(folder));
  const std::string page_with_data = content(folder / "report.html");
  const std::string_view empty = page();
  const std::size_t mark = empty.find(kDataMark);
  REQUIRE(mark != std::string_view::npos);
  CHECK(page_with_data.starts_with(empty.substr(0, mark)));
  CHECK(page_with_data.ends_with(empty.substr(mark + kDataMark.size())));
  CHECK(page_with_data.find(kDataMark) == std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "report.html.stride-new"));
}

TEST_CASE("the data is what was recorded") {
  const TemporaryFolder folder;
  const json data = written(folder, sample(folder));
  CHECK(data["format"] == 1);
  CHECK(data["stride"] == "1.2.3");
  CHECK(data["run"] == json{{"outcome", "completed"}, {"error", "</script>"}});
  CHECK(data["notes"] == json{"something is missing"});
  CHECK(data["rows"] == 2);
  CHECK(unpacked<std::int64_t>(data["time"]) == std::vector<std::int64_t>{0, 1});
  const json& columns = data["columns"];
  REQUIRE(columns.size() == 3);
  CHECK(columns[0]["name"] == "a.x");
  CHECK(columns[0]["unit"] == "m");
  CHECK(columns[0]["type"] == "Float64");
  CHECK(columns[0]["stepped"] == false);
  const std::vector<double> x = unpacked<double>(columns[0]["values"]);
  CHECK(std::isnan(x[0]));
  CHECK(x[1] == -std::numeric_limits<double>::infinity());
  CHECK(columns[1]["name"] == "a.<n>");
  CHECK(columns[1]["stepped"] == true);
  CHECK(unpacked_texts(columns[1]["values"]) == std::vector<std::string>{"9007199254740993", "1"});
  CHECK(unpacked<std::uint8_t>(columns[2]["values"]) == std::vector<std::uint8_t>{1, 0});
}

TEST_CASE("coverage is in the data as coverage.json has it, where there is some") {
  const TemporaryFolder folder;
  Results results = sample(folder);
  CHECK_FALSE(written(folder, results).contains("coverage"));
  coverage::PointReport point{.name = "p", .signal = "</script>"};
  point.bins = {{.name = "on", .count = 2, .first = 0.5}, {.name = "off"}};
  results.coverage = {.scenario = "s", .groups = {{.component = "a", .points = {point}}}};
  const json group = written(folder, results)["coverage"]["groups"][0];
  CHECK(group["percentage"] == 50);
  CHECK(group["points"][0]["signal"] == "</script>");
  CHECK(group["points"][0]["bins"][0] == json{{"name", "on"}, {"count", 2}, {"first", 0.5}});
}

TEST_CASE("messages, activities, films and the diagram") {
  const TemporaryFolder folder;
  const json data = written(folder, sample(folder));
  CHECK(data["messages"] == json::parse(R"([{"time": "14200358702064", "index": 1,
    "component": "a", "variable": "y", "direction": "sent", "payload": "00e8",
    "content": "</script><!--\uFFFD"}])"));
  const json& activity = data["activity"].at(0);
  CHECK(activity["component"] == "a");
  CHECK(activity["kind"] == "idle");
  CHECK(unpacked<std::int64_t>(activity["from"]) == std::vector<std::int64_t>{0, 5});
  CHECK(unpacked<std::int64_t>(activity["until"]) == std::vector<std::int64_t>{4, 9});
  const json& film = data["films"].at(0);
  CHECK(film["component"] == "world");
  CHECK(unpacked<std::int64_t>(film["times"]) == std::vector<std::int64_t>{0, 7});
  CHECK(film["frames"] == json{"data:image/jpeg;base64,emVybw==", "data:image/png;base64,b25l"});
  CHECK(data["diagram"] == json::parse(R"({
    "components": [{"name": "a", "model": "A"}, {"name": "b", "model": "B"}],
    "connections": [{"from": "a.x", "to": "b.u", "kind": "value"}]})"));
}

TEST_CASE("worlds are in the data, with what draws them and its licences") {
  const TemporaryFolder folder;
  Results results = sample(folder);
  folder.write("world.glb", "glTF and <more>");
  results.worlds = {{"the <world>", "world.glb"}};
  const json data = written(folder, results);
  REQUIRE(data["worlds"].size() == 1);
  CHECK(data["worlds"][0]["component"] == "the <world>");
  const auto bytes = unpacked<std::uint8_t>(data["worlds"][0]["file"]);
  CHECK(std::string(bytes.begin(), bytes.end()) == "glTF and <more>");
  const auto script = unpacked<std::uint8_t>(data["world_script"]);
  CHECK_THAT(std::string(script.begin(), script.end()), Contains("strideWorld"));
  const std::string with_world = content(folder / "report.html");
  CHECK(with_world.find(world_licences()) < with_world.find("stride-report"));
}

TEST_CASE("a page without a world has nothing of it") {
  const TemporaryFolder folder;
  const json data = written(folder, sample(folder));
  CHECK_FALSE(data.contains("worlds"));
  CHECK_FALSE(data.contains("world_script"));
  CHECK(content(folder / "report.html").find(world_licences()) == std::string::npos);
}

TEST_CASE("plots are the scenario's, or else the default ones") {
  const TemporaryFolder folder;
  Results results = sample(folder);
  CHECK(written(folder, results)["plots"] == json::parse(R"([
    {"title": "a [m]", "signals": ["a.x"]},
    {"title": "a: states and counts", "signals": ["a.<n>", "a.on"]}])"));
  results.run.plots = {{"Place", {"a.x"}}};
  CHECK(written(folder, results)["plots"] ==
        json::parse(R"([{"title": "Place", "signals": ["a.x"]}])"));
}

TEST_CASE("an empty folder makes a page without a run") {
  const TemporaryFolder folder;
  const json data = written(folder, {});
  CHECK(data["run"].is_null());
  CHECK(data["columns"].empty());
  CHECK(data["messages"].empty());
}

TEST_CASE("the same results make the same bytes") {
  const TemporaryFolder folder;
  written(folder, sample(folder));
  const std::string first = content(folder / "report.html");
  written(folder, sample(folder));
  CHECK(content(folder / "report.html") == first);
}

TEST_CASE("where it fails the page before stays, and no part of a new one") {
  const TemporaryFolder folder;
  folder.write("report.html", "old");
  Results results = sample(folder);
  results.films[0].pictures[1] = "gone.jpg";
  CHECK_THAT(error_of([&] { write_report(folder / "report.html", results, ""); }),
             Contains("gone.jpg: cannot read the picture"));
  CHECK(content(folder / "report.html") == "old");
  CHECK_FALSE(std::filesystem::exists(folder / "report.html.stride-new"));
}

TEST_CASE("a file that cannot be written is named") {
  const TemporaryFolder folder;
  CHECK_THAT(error_of([&] { write_report(folder / "none/report.html", {}, ""); }),
             Contains("none/report.html") && Contains("the folder of this file does not exist"));
  std::filesystem::create_directories(folder / "report.html/x");
  CHECK_THAT(error_of([&] { write_report(folder / "report.html", {}, ""); }),
             Contains("report.html: this is a folder"));
}

TEST_CASE("real numbers are grouped by component and unit, all else by component") {
  const std::vector<Column> columns = {column("a.x", "m"),
                                       column("a.led", "", ValueType::Boolean),
                                       column("b.x", "m"),
                                       column("a.v", "m/s"),
                                       column("a.y", "m"),
                                       column("a.count", "", ValueType::UInt64),
                                       column("b.gain", "", ValueType::Float32)};
  const std::vector<RunFile::Component> components = {{"a", "A"}, {"b", "B"}};
  CHECK(default_plots(columns, components) ==
        std::vector<Plot>{{"a [m]", {"a.x", "a.y"}},
                          {"a: states and counts", {"a.led", "a.count"}},
                          {"b [m]", {"b.x"}},
                          {"a [m/s]", {"a.v"}},
                          {"b", {"b.gain"}}});
}

TEST_CASE("a component of a nested system is the longest that the name begins with") {
  const std::vector<Column> columns = {column("arm.motor.speed", ""), column("arm.x", ""),
                                       column("armada.x", ""), column("height", "m")};
  const std::vector<RunFile::Component> components = {{"arm", "A"}, {"arm.motor", "M"}};
  CHECK(default_plots(columns, components) == std::vector<Plot>{{"arm.motor", {"arm.motor.speed"}},
                                                                {"arm", {"arm.x"}},
                                                                {"outputs", {"armada.x"}},
                                                                {"outputs [m]", {"height"}}});
}

TEST_CASE("where the components are not known, the first point ends one") {
  const std::vector<Column> columns = {column("a.b.x", "m"), column("a.c", "m"), column("d", "m")};
  CHECK(default_plots(columns, {}) ==
        std::vector<Plot>{{"a [m]", {"a.b.x", "a.c"}}, {"d [m]", {"d"}}});
}

TEST_CASE("a live page is the same, but that it may connect to where it comes from") {
  const TemporaryFolder folder;
  const Results results = sample(folder);
  write_report(folder / "report.html", results, "1.2.3");
  std::string live = live_report(results, "1.2.3");
  for (const std::string added : {"<meta name=\"stride-live\">\n", "connect-src 'self'; "}) {
    INFO(added);
    const std::size_t at = live.find(added);
    REQUIRE(at < live.find("<title>"));
    live.erase(at, added.size());
  }
  CHECK(live == content(folder / "report.html"));
}
