#include "master/report/results.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "master/observe/recorders/unit_folders.h"
#include "master/report/world_file.h"
#include "tests/at.h"
#include "tests/master/report/support.h"

using namespace stride;
using namespace stride::report;
using Catch::Contains;
using Catch::Equals;
using Catch::StartsWith;
using stride::tests::at_picosecond;
using stride::tests::at_picoseconds;

namespace {

constexpr std::int64_t kMillisecond = 1'000'000'000;  // [ps]

const char* const kRun = R"({
  "outcome": "completed",
  "signals": [{"name": "a.x", "unit": "m", "type": "Float64", "variability": "continuous"}],
  "units": [{"name": "a", "model": "A"}],
  "connections": [{"from": "a.x", "to": "b.u"}]
})";

/// A folder with all that a run leaves.
struct Folder {
  TemporaryFolder folder;

  Folder() {
    folder.write("run.json", kRun);
    folder.write("signals.csv", "time,a.x [m]\n0,1\n0.001,2\n");
    folder.write("events.csv",
                 "time,index,component,variable,direction,payload,content\n"
                 "0.0005,2,\"b, c\",y,sent,00ff,\"set_led 1, \"\"on\"\"\"\n");
    folder.write("activity.csv",
                 "time,until,component,kind\n"
                 "0,0,a,event\n0,0.001,a,idle\n0.001,0.002,a,idle\n");
    folder.write("signals.vcd", "");
  }
  Results read(const Limits& limits = {}) const {
    return read_results(folder / "", recorders::ResultFiles(), limits);
  }
  void film(const std::string& list) const {
    std::filesystem::create_directories(folder / "units/world/film");
    folder.write("units/world/film/frames.csv", list);
    folder.write("units/world/film/0.jpg", "zero");
    folder.write("units/world/film/1.jpg", "one");
  }
  void world(const std::string& content) const {
    std::filesystem::create_directories(folder / "units/world");
    folder.write("units/world/world.glb", content);
  }
};

/// A binary glTF 2.0 file.
std::string glb(const std::string& text, const std::string& binary) {
  const auto number = [](std::size_t value) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
    return bytes;
  };
  return "glTF" + number(2) + number(28 + text.size() + binary.size()) + number(text.size()) +
         "JSON" + text + number(binary.size()) + std::string("BIN\0", 4) + binary;
}

const std::string kTriangle =
    R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"children":[1]},{"mesh":0}],)"
    R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
    R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},)"
    R"({"bufferView":1,"componentType":5123,"type":"SCALAR","count":3},)"
    R"({"bufferView":0,"componentType":5126,"type":"SCALAR","count":9}],)"
    R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},)"
    R"({"buffer":0,"byteOffset":36,"byteLength":6}],"buffers":[{"byteLength":42}]})";

/// Before "scenes": further accessors, of 9 numbers, and an animation.
std::string animated(int input, int output) {
  return fmt::format(R"("animations":[{{"samplers":[{{"input":{},"output":{}}}]}}],"scenes")",
                     input, output);
}

/// The same file in which one part of the text is another one.
std::string with(const std::string& part, const std::string& other) {
  std::string text = kTriangle;
  return glb(text.replace(text.find(part), part.size(), other), std::string(42, '\0'));
}

}  // namespace

TEST_CASE("a results folder is read") {
  const Folder f;
  const Results results = f.read();
  CHECK(results.notes.empty());
  CHECK(results.signals.times == at_picoseconds({0, kMillisecond}));
  REQUIRE(results.messages.size() == 1);
  const RecordedMessage& message = results.messages[0];
  CHECK(message.time == at_picosecond(kMillisecond / 2));
  CHECK(message.index == 2);
  CHECK(message.component == "b, c");
  CHECK(message.variable == "y");
  CHECK(message.direction == "sent");
  CHECK(message.payload == "00ff");
  CHECK(message.content == "set_led 1, \"on\"");
  REQUIRE(results.activities.size() == 2);
  CHECK(results.activities[0].kind == "event");
  CHECK(results.activities[1].kind == "idle");
  CHECK(results.activities[1].component == "a");
  CHECK(results.activities[1].from == at_picoseconds({0, kMillisecond}));
  CHECK(results.activities[1].until == at_picoseconds({kMillisecond, 2 * kMillisecond}));
  CHECK(results.films.empty());
}

TEST_CASE("coverage is there if it can be read, and else that is noted") {
  const Folder f;
  CHECK_FALSE(f.read().coverage);
  f.folder.write("coverage.json",
                 R"({"format": "stride coverage", "version": 1, "scenario": "s", "definition": "d",
                     "groups": [{"component": "a", "points": []}]})");
  const Results results = f.read();
  REQUIRE(results.coverage);
  CHECK(results.coverage->groups.at(0).component == "a");
  f.folder.write("coverage.json", "{}");
  const Results broken = f.read();
  CHECK_FALSE(broken.coverage);
  CHECK_THAT(broken.notes.back(), Catch::Contains("coverage.json: this is no coverage"));
}

TEST_CASE("messages without the column content have none") {
  const Folder f;
  f.folder.write("events.csv",
                 "time,index,component,variable,direction,payload\n0,0,a,y,sent,00ff\n");
  CHECK(f.read().messages.at(0).content.empty());
}

TEST_CASE(
    "pictures are found in the folders of units, with their instants; a missing one is reported") {
  const Folder f;
  f.film("time,file\n0,0.jpg\n0.001,gone.jpg\n0.002,1.jpg\n");
  const Results results = f.read();
  REQUIRE(results.films.size() == 1);
  CHECK(results.films[0].component == "world");
  CHECK(results.films[0].times == at_picoseconds({0, 2 * kMillisecond}));
  CHECK(results.films[0].pictures[1].filename() == "1.jpg");
  REQUIRE(results.notes.size() == 1);
  CHECK(results.notes[0] == "units/world/film/frames.csv: 1 of its pictures are missing");
}

TEST_CASE("a picture is of the film's own folder, whatever its name says") {
  const Folder f;
  f.film("time,file\n0,../../1.jpg\n");
  CHECK(f.read().films.at(0).pictures.at(0) == "units/world/film/1.jpg");
}

TEST_CASE("a film has the name of the component whose folder it is in") {
  const Folder f;
  f.film("time,file\n0,0.jpg\n");
  std::filesystem::rename(f.folder / "units/world", f.folder / "units/50%25%2Fx");
  CHECK(f.read().films.at(0).component == "50%/x");
}

TEST_CASE("no link below the folder is followed to a film") {
  const Folder f;
  f.film("time,file\n0,0.jpg\n1,1.jpg\n");
  const tests::TemporaryFolder outside;
  const char* const refused = ": left out: it is a link, or its list is no regular file";
  SECTION("a picture") {
    std::filesystem::remove(f.folder / "units/world/film/1.jpg");
    std::filesystem::create_symlink(outside.write("1.jpg", "secret"),
                                    f.folder / "units/world/film/1.jpg");
    const Results results = f.read();
    CHECK(results.films.at(0).times == at_picoseconds({0}));
    CHECK_THAT(results.notes.at(0),
               Equals("units/world/film/frames.csv: 1 of its pictures are left out: they are "
                      "links, no regular files, or larger than 16 MiB"));
  }
  SECTION("the list") {
    std::filesystem::rename(f.folder / "units/world/film/frames.csv", outside / "frames.csv");
    std::filesystem::create_symlink(outside / "frames.csv",
                                    f.folder / "units/world/film/frames.csv");
    const Results results = f.read();
    CHECK(results.films.empty());
    CHECK_THAT(results.notes.at(0), Equals(std::string("units/world/film") + refused));
  }
  SECTION("the film, the unit's folder, or that of all units") {
    const std::string link = GENERATE("units/world/film", "units/world", "units");
    std::filesystem::rename(f.folder / link, outside / "there");
    std::filesystem::create_symlink(outside / "there", f.folder / link);
    const Results results = f.read();
    CHECK(results.films.empty());
    CHECK_THAT(results.notes.at(0), Equals(std::string("units/world/film") + refused));
  }
}

TEST_CASE("a component's world is a binary glTF 2.0 file, or is left out with the reason") {
  const Folder f;
  const std::string whole = glb(kTriangle, std::string(42, '\0'));
  SECTION("whole") {
    f.world(whole);
    const Results results = f.read();
    CHECK(results.notes.empty());
    REQUIRE(results.worlds.size() == 1);
    CHECK(results.worlds[0].component == "world");
    CHECK(results.worlds[0].file == "units/world/world.glb");
  }
  SECTION("not whole") {
    const auto [content, reason] = GENERATE_COPY(table<std::string, std::string>(
        {{whole.substr(0, whole.size() - 1),
          fmt::format("it has {} bytes, but its header says {}", whole.size() - 1, whole.size())},
         {whole.substr(0, 11), "it is cut off"},
         {"", "it is no binary glTF 2.0 file"},
         {std::string("glTF\1\0\0\0\x10\0\0\0rest", 16), "it is no binary glTF 2.0 file"},
         {"{\"asset\": {\"version\": \"2.0\"}}", "it is no binary glTF 2.0 file"},
         {glb("{\"asset\"", ""), "its JSON is not well-formed, or no object"},
         {glb("[]", ""), "its JSON is not well-formed, or no object"},
         {glb(kTriangle, std::string(41, '\0')),
          "its buffer has 42 bytes, and the file holds 41 of them"},
         {with("byteLength\":6", "byteLength\":7"), "7 bytes from 36 on are not within its buffer"},
         {with("byteOffset\":36", "byteOffset\":18446744073709551615"),
          "6 bytes from 18446744073709551615 on are not within its buffer"},
         {with("count\":3", "count\":1000000000"),
          "an accessor has 1000000000 elements, more than its 36 bytes can be"},
         {with("5123", "5125"), "an accessor has 3 elements, more than its 6 bytes can be"},
         {with("5123", "1"), "an accessor is of no known type"},
         {with("POSITION\":0", "POSITION\":3"), "it refers to number 3 of its 3 'accessors'"},
         {with("POSITION\":0", "POSITION\":-1"), "a number is no index of 'accessors'"},
         {with("count\":3}", R"(count":3,"sparse":{"count":4}})"),
          "an accessor has 3 elements, and others for 4"},
         {with("count\":3}", R"(count":3,"sparse":{"count":1,"indices":{"bufferView":9,)"
                             R"("componentType":5121},"values":{"bufferView":0}}})"),
          "it refers to number 9 of its 2 'bufferViews'"},
         {with("\"scenes\"", R"("skins":[{"joints":[7]}],"scenes")"),
          "it refers to number 7 of its 2 'nodes'"},
         {with("[{\"nodes\":[0]}]", "[1]"), "an entry of 'scenes' is no object"},
         {glb(kTriangle, std::string(36, '\0') + std::string("\0\0\1\0\3\0", 6)),
          "it refers to element 3 of 3"},
         {with("2.0\"}", "3.0\"}"), "it is no glTF 2.0"},
         {with("\"scenes\"", R"("extensionsRequired":["KHR_draco_mesh_compression"],"scenes")"),
          "it needs the extension KHR_draco_mesh_compression, which is not known here"},
         {with("{\"mesh\":0", "{\"rotation\":[0,0,0],\"mesh\":0"), "'rotation' are not 4 numbers"},
         {with("{\"mesh\":0", "{\"scale\":null,\"mesh\":0"), "'scale' is no list"},
         {with("\"scenes\"", animated(0, 1)), "the times of its animation are no float numbers"},
         {with("\"scenes\"", animated(2, 2)), "the times of its animation do not grow"},
         {with("\"scenes\"", animated(2, 0)), "a part of its animation has 9 times, but 3 values"},
         {with("mesh\":0", "mesh\":1"), "it refers to number 1 of its 1 'meshes'"},
         {with("mesh\":0", "mesh\":\"a\""), "'mesh' is a string, no index or size"},
         {with("\"buffers\":[{", "\"buffers\":[{\"uri\":\"a.bin\","),
          "its buffer is not its binary part"},
         {with("\"nodes\":[{\"", "\"images\":[{\"uri\":\"a.png\"}],\"nodes\":[{\""),
          "one of its images is not in its binary part"},
         {with("\"children\":[1]", "\"children\":[1,1]"), "node 1 has two parents"},
         {with("\"children\":[1]", "\"children\":[0]"), "node 0 is a root and has a parent"},
         {with("\"children\":[1]", "\"children\":[9]"), "it refers to number 9 of its 2 'nodes'"},
         {with("\"scenes\":[{\"nodes\":[0]}]", "\"scenes\":[]"), "it has no scene"}}));
    f.world(content);
    const Results results = f.read();
    CHECK(results.worlds.empty());
    REQUIRE(results.notes.size() == 1);
    CHECK(results.notes[0] == "units/world/world.glb: left out: " + reason);
  }
  SECTION("too large") {
    f.world(whole);
    std::filesystem::resize_file(f.folder / "units/world/world.glb", kLargestWorld + 1);
    CHECK(f.read().worlds.empty());
    CHECK(f.read().notes.at(0) == "units/world/world.glb: left out: it is larger than 64 MiB");
  }
  SECTION("a link") {
    f.world(whole);
    std::filesystem::rename(f.folder / "units/world/world.glb", f.folder / "elsewhere.glb");
    std::filesystem::create_symlink(f.folder / "elsewhere.glb", f.folder / "units/world/world.glb");
    CHECK(f.read().worlds.empty());
    CHECK(f.read().notes.at(0) ==
          "units/world/world.glb: left out: it is a link, or no regular file");
  }
}

TEST_CASE("a film that is too long for a page is cut") {
  const Folder f;
  f.film("time,file\n0,0.jpg\n1,1.jpg\n2,0.jpg\n");
  const char* const note = "units/world/film/frames.csv: the first 2 of its pictures are shown";
  SECTION("by the number of its pictures") {
    const Results results = f.read({.pictures = 2});
    CHECK(results.films.at(0).times.size() == 2);
    CHECK_THAT(results.notes.at(0), Equals(note));
  }
  SECTION("by their size") {
    const Results results = f.read({.picture_bytes = 6});
    CHECK(results.films.at(0).times.size() == 2);
    CHECK_THAT(results.notes.at(0), Equals(note));
  }
  CHECK(f.read({.pictures = 3, .picture_bytes = 11}).notes.empty());
}

TEST_CASE("a folder without run.json has results, too") {
  const Folder f;
  std::filesystem::remove(f.folder / "run.json");
  const Results results = f.read();
  CHECK(results.run.json.is_null());
  CHECK(results.signals.times.size() == 2);
  CHECK_THAT(results.notes.at(0), Equals("run.json: this file is missing"));
}

TEST_CASE("with a broken run.json the rest is shown, and the mistake is reported") {
  const Folder f;
  const auto [text, note] = GENERATE(table<std::string, std::string>({
      {"", "run.json:1: this is not JSON: the file is empty"},
      {"{\"outcome\": \"comp", "run.json:1: this is not JSON, in column "},
      {"{\"units\": 1}", "run.json: this is not what `stride run` writes: 'units' is of the type"},
  }));
  f.folder.write("run.json", text);
  const recorders::ResultFiles files = result_files(f.folder / "");
  CHECK(files.statistics == "run.json");
  const Results results = read_results(f.folder / "", files);
  CHECK(results.run.json.is_null());
  CHECK(results.signals.times.size() == 2);
  CHECK(results.messages.size() == 1);
  REQUIRE(results.notes.size() == 1);
  CHECK_THAT(results.notes[0], Contains(note) && Contains("the report is without what it holds"));
}

TEST_CASE("a film in a folder whose name is shortened has the whole name of its component") {
  const Folder f;
  const std::string name(300, 'n');
  f.film("time,file\n0,0.jpg\n");
  std::filesystem::rename(f.folder / "units/world",
                          f.folder / ("units/" + recorders::unit_folder_name(name)));
  f.folder.write("run.json", R"({"units": [{"name": ")" + name + R"(", "model": "A"}]})");
  CHECK(f.read().films.at(0).component == name);
  f.folder.write("run.json", "{}");
  CHECK_THAT(f.read().films.at(0).component, Catch::StartsWith("nnn") && Catch::EndsWith("n…"));
}

TEST_CASE("of a run that goes on the rest of a line is still to come, which is not reported") {
  const Folder f;
  f.folder.write("signals.csv", "time,a.x [m]\n0,1\n0.0");
  f.folder.write("events.csv", "time,index,component,variable,direction,payload\n0,0,a");
  const Results results = read_results(f.folder / "", {}, {}, RunState::GoingOn);
  CHECK(results.signals.times.size() == 1);
  CHECK(results.messages.empty());
  for (const std::string& note : results.notes) CHECK_THAT(note, !Contains("cut off"));
  CHECK(f.read().notes.size() == results.notes.size() + 2);
}

TEST_CASE("the results of a killed run are shown, and what was cut off is reported") {
  const Folder f;
  std::filesystem::remove(f.folder / "run.json");
  f.folder.write("signals.csv", "time,a.x [m]\n0,1\n0.0");
  f.folder.write("events.csv", "time,index,component,variable,direction,payload\n0,0,a");
  f.folder.write("activity.csv", "");
  const Results results = f.read();
  CHECK(results.signals.times.size() == 1);
  CHECK(results.messages.empty());
  CHECK(results.activities.empty());
  REQUIRE(results.notes.size() == 3);
  CHECK_THAT(results.notes[1], Contains("signals.csv:3: the last line was cut off"));
  CHECK_THAT(results.notes[2], Contains("events.csv:2: the last line was cut off"));
}

TEST_CASE("files that are empty behind the end of a run are reported") {
  const Folder f;
  for (const char* name : {"signals.csv", "events.csv", "activity.csv"}) f.folder.write(name, "");
  const Results results = f.read();
  REQUIRE(results.notes.size() == 3);
  CHECK_THAT(results.notes[0], Equals("signals.csv: the file is empty, without the header that its "
                                      "run has written"));
  CHECK_THAT(results.notes[2], StartsWith("activity.csv: the file is empty"));
  f.folder.write("run.json", R"({"outcome": "running"})");
  CHECK(f.read().notes.empty());
}

TEST_CASE("what the scenario has switched off is not missed") {
  const Folder f;
  recorders::ResultFiles files;
  files.events.clear();
  files.activity.clear();
  const Results results = read_results(f.folder / "", files);
  CHECK(results.notes.empty());
  CHECK(results.messages.empty());
}

TEST_CASE("more messages than a page can show are counted") {
  const Folder f;
  std::string text = "time,index,component,variable,direction,payload\n";
  for (int i = 0; i < 5; ++i) text += "0,0,a,y,sent,\n";
  f.folder.write("events.csv", text);
  const Results results = f.read({.messages = 3});
  CHECK(results.messages.size() == 3);
  CHECK_THAT(results.notes.at(0), Contains("events.csv: the first 3 of 5 messages are shown"));
}

TEST_CASE("what cannot be read is left out, and noted with file, line and column") {
  const Folder f;
  const auto note = [&] {
    const Results results = f.read();
    CHECK(results.signals.times.size() == 2);
    return results.notes.at(0);
  };
  SECTION("a file without a column") {
    f.folder.write("events.csv", "time,component\n");
    CHECK_THAT(note(), Contains("events.csv:1: the header has no column 'index'; the report is "
                                "without what it holds"));
  }
  SECTION("rows") {
    f.folder.write("events.csv",
                   "time,index,component,variable,direction,payload\n"
                   "0,x,a,y,sent,\n0,1,a,y,sent,\n0,1,a\nsoon,1,a,y,sent,\n0,2,a,y,sent,\n");
    CHECK_THAT(note(), Contains("events.csv:2: column 'index': expected an integer, found 'x'; "
                                "this row and 2 more are left out"));
    CHECK(f.read().messages.size() == 2);
  }
  SECTION("the rest of a file whose quotation marks are out of place") {
    f.folder.write("events.csv",
                   "time,index,component,variable,direction,payload\n"
                   "0,1,a,y,sent,\n0,2,\"a\"b,y,sent,\n0,3,a,y,sent,\n");
    CHECK_THAT(note(), Contains("events.csv:3: ") && Contains("the rows from line 3 on"));
    CHECK(f.read().messages.size() == 1);
  }
  SECTION("an activity") {
    f.folder.write("activity.csv",
                   "time,until,component,kind\n1,0,a,idle\n1,2,a,idle\nx,2,b,idle\n");
    CHECK_THAT(note(), Contains("activity.csv:2: column 'until': it ends before it begins; this "
                                "row and 1 more are left out"));
    CHECK(f.read().activities.size() == 1);
  }
  SECTION("a picture") {
    f.film("time,file\n0,0.jpg\n0,1.jpg\n");
    CHECK_THAT(note(), Contains("frames.csv:3: column 'time': the time does not grow; this row"));
    CHECK(f.read().films.at(0).times.size() == 1);
  }
  SECTION("a film without a column") {
    f.film("time\n0\n");
    CHECK_THAT(note(), Contains("frames.csv:1: the header has no column 'file'"));
    CHECK(f.read().films.empty());
  }
}

TEST_CASE("the names of the files are those in run.json") {
  const Folder f;
  f.folder.write("run.json", R"({"files": {"signals": "s.csv", "statistics": "run.json"}})");
  const recorders::ResultFiles files = result_files(f.folder / "");
  CHECK(files.signals == "s.csv");
  CHECK(files.events.empty());
  CHECK(files.statistics == "run.json");
  std::filesystem::remove(f.folder / "run.json");
  CHECK(result_files(f.folder / "").events == "events.csv");
}

TEST_CASE("a folder without results is refused") {
  const TemporaryFolder folder;
  folder.write("something", "");
  CHECK_THAT(error_of([&] { result_files(folder / ""); }), Contains("there are no results"));
  CHECK_THAT(error_of([&] { result_files(folder / "none"); }), Contains("this is not a folder"));
}
