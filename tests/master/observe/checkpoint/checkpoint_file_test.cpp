#include "master/observe/checkpoint/checkpoint_file.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "master/base/archive/unpacked_archive.h"
#include "master/base/archive/zip.h"
#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/sha256.h"
#include "master/base/state_archive.h"
#include "tests/master/base/archive/support.h"

using namespace stride;
using namespace stride::checkpoint;
using Catch::Contains;
using stride::tests::Scratch;

namespace {

Checkpoint example() {
  Checkpoint made{.provenance = {"9.9.9",
                                 "2026-01-01T00:00:00Z",
                                 "desk",
                                 {{{"run", "a b.ssd"}, "/somewhere"}, {{"resume", "x"}, "/else"}},
                                 {{"the scenario", "/somewhere/a b.ssd", "0f"}}},
                  .time = Time(Duration(14'200'000'000'001)),
                  .results = "/somewhere/results/a",
                  .interventions = 3};
  made.units["robot arm"] = "serialised, 12 kB";
  made.states["simulation"] = {std::byte{1}, std::byte{0}, std::byte{255}};
  made.states["unit/a/b%"] = Bytes(100'000, std::byte{7});
  made.states["empty"] = {};
  return made;
}

}  // namespace

TEST_CASE("a checkpoint is read back as it was written") {
  const Scratch scratch;
  write_checkpoint(scratch / "c.zip", example());
  const Checkpoint read = read_checkpoint(scratch / "c.zip");
  CHECK(read.time == example().time);
  CHECK(read.results == example().results);
  CHECK(read.interventions == 3);
  CHECK(read.units == example().units);
  CHECK(read.states == example().states);
  CHECK(read.provenance.version == "9.9.9");
  CHECK(read.provenance.sources == example().provenance.sources);
  REQUIRE(read.provenance.commands.size() == 2);
  CHECK(read.provenance.commands[0].words == std::vector<std::string>{"run", "a b.ssd"});
  CHECK(read.provenance.commands[1].folder == "/else");
  CHECK(&state_of(read, "empty") == &read.states.at("empty"));
  CHECK_THROWS_WITH(state_of(read, "none"), Contains("no state of 'none'"));
}

TEST_CASE("a checkpoint of a run whose paths are not UTF-8 is written, with U+FFFD in them") {
  const Scratch scratch;
  Checkpoint made = example();
  made.results = "/somewhere/caf\xe9";
  made.provenance.sources[0].path = "/somewhere/\xff.ssd";
  write_checkpoint(scratch / "c.zip", made);
  const Checkpoint read = read_checkpoint(scratch / "c.zip");
  CHECK(read.results == "/somewhere/caf\uFFFD");
  CHECK(read.provenance.sources[0].path == "/somewhere/\uFFFD.ssd");
}

TEST_CASE("what is no checkpoint is refused, by its name") {
  const Scratch scratch;
  scratch.write("text.zip", "no archive");
  CHECK_THROWS_WITH(read_checkpoint(scratch / "text.zip"), Contains("text.zip"));
  archive::Contents contents;
  contents["other.txt"].text = "x";
  archive::write_zip(scratch / "other.zip", contents);
  CHECK_THROWS_WITH(read_checkpoint(scratch / "other.zip"),
                    Contains("other.zip: this is no checkpoint: it has no checkpoint.json"));
  contents["checkpoint.json"].text = "{\"stride checkpoint\": 99}";
  archive::write_zip(scratch / "new.zip", contents);
  CHECK_THROWS_WITH(read_checkpoint(scratch / "new.zip"), Contains("has the format 99"));
  contents["checkpoint.json"].text = "{\"stride checkpoint\": 2";
  archive::write_zip(scratch / "cut.zip", contents);
  CHECK_THROWS_WITH(read_checkpoint(scratch / "cut.zip"), Contains("or a damaged one"));
  contents["checkpoint.json"].text = "[\"stride checkpoint\", 1]";
  archive::write_zip(scratch / "list.zip", contents);
  CHECK_THROWS_WITH(read_checkpoint(scratch / "list.zip"), Contains("or a damaged one"));
}

TEST_CASE("a state that is not what was written is found") {
  const Scratch scratch;
  archive::Contents contents;
  contents["checkpoint.json"].text =
      R"({"stride checkpoint": 2, "time": "0.5", "results": "r", "interventions": 0,
          "provenance": {"version": "1", "date": "", "host": "", "commands": [], "sources": []}, "units": [],
          "states": [{"name": "simulation",
                      "sha256": "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"}]})";
  contents["checkpoint.sha256"].text = core::sha256(contents["checkpoint.json"].text);
  contents["states/0"].text = "abc";
  archive::write_zip(scratch / "good.zip", contents);
  CHECK(read_checkpoint(scratch / "good.zip").states.at("simulation").size() == 3);
  contents["states/0"].text = "abd";
  archive::write_zip(scratch / "bad.zip", contents);
  CHECK_THROWS_WITH(read_checkpoint(scratch / "bad.zip"),
                    Contains("the state of 'simulation' is not what was written"));
  contents.erase("states/0");
  archive::write_zip(scratch / "less.zip", contents);
  CHECK_THROWS_WITH(read_checkpoint(scratch / "less.zip"), Contains("'simulation'"));
  std::string& text = contents["checkpoint.json"].text;
  text.replace(text.find("0.5"), 3, "now");
  contents["checkpoint.sha256"].text = core::sha256(text);
  archive::write_zip(scratch / "time.zip", contents);
  CHECK_THROWS_WITH(read_checkpoint(scratch / "time.zip"), Contains("or a damaged one: 'now'"));
}

TEST_CASE("a checkpoint that cannot be written leaves the earlier one") {
  const Scratch scratch;
  write_checkpoint(scratch / "c.zip", example());
  const std::string before = core::read_input(scratch / "c.zip");
  CHECK_THROWS_AS(write_checkpoint(scratch / "none/c.zip", example()), core::Error);
  CHECK(core::read_input(scratch / "c.zip") == before);
}

TEST_CASE("a checkpoint whose description was edited is refused") {
  const Scratch scratch;
  write_checkpoint(scratch / "c.zip", example());
  const archive::UnpackedArchive unpacked(scratch / "c.zip", "a checkpoint");
  const std::filesystem::path folder = scratch / "edited";
  std::filesystem::copy(unpacked.folder(), folder, std::filesystem::copy_options::recursive);
  CHECK(read_checkpoint(folder).time == example().time);
  std::string text = core::read_input(folder / "checkpoint.json");
  text.replace(text.find("a b.ssd"), 7, "other.s");
  std::ofstream(folder / "checkpoint.json") << text;
  CHECK_THROWS_WITH(read_checkpoint(folder), Contains("edited: the checkpoint is damaged, or was "
                                                      "changed: its checkpoint.json is not"));
}
