// Checkpoints, and the branches of a run.
#include "master/base/archive/zip.h"
#include "master/base/files/input_file.h"
#include "master/base/files/sha256.h"
#include "master/observe/checkpoint/checkpoint_file.h"
#include "master/system/scenario/branches.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

checkpoint::Checkpoint small_checkpoint() {
  checkpoint::Checkpoint made{.provenance = {.version = "0.1.0",
                                             .date = "2026-01-01T00:00:00Z",
                                             .host = "desk",
                                             .commands = {{{"run", "a.ssd"}, "/tmp"}},
                                             .sources = {{"the scenario", "/tmp/a.ssd", "00"}}},
                              .time = Time(Duration(1'500'000'000'000)),
                              .results = "/tmp/results/a",
                              .interventions = 1};
  made.units["a"] = "serialised, 12 B";
  made.states["simulation"] = {std::byte{1}, std::byte{2}};
  made.states["unit/a"] = {std::byte{3}};
  return made;
}

std::string written_checkpoint() {
  const auto file = write_file("checkpoint.zip", "");
  checkpoint::write_checkpoint(file, small_checkpoint());
  return core::read_input(file);
}

void read_checkpoint(const std::string& bytes) {
  const auto file = write_file("checkpoint.zip", bytes);
  refusing_input("", [&] { checkpoint::read_checkpoint(file); });
}

/// In an archive that is whole.
void read_description(const std::string& bytes) {
  const auto file = write_file("checkpoint.zip", "");
  archive::Contents contents;
  contents["checkpoint.json"].text = bytes;
  contents["checkpoint.sha256"].text = core::sha256(bytes);
  contents["states/0"].text = "ab";
  archive::write_zip(file, contents);
  refusing_input("", [&] { checkpoint::read_checkpoint(file); });
}

void read_branches(const std::string& bytes) {
  const auto file = write_file("branches.xml", bytes);
  refusing_input("", [&] { scenario::read_branches(file); });
}

const Registration kCheckpointParsers(
    "checkpoint",
    {
        {.name = "checkpoint_file", .read = read_checkpoint, .make_seed = written_checkpoint},
        {.name = "checkpoint_description",
         .read = read_description,
         .seeds = {R"({"stride checkpoint": 2, "time": "1.5",
           "results": "/tmp", "interventions": 0,
           "provenance": {"version": "0.1.0", "date": "2026-01-01T00:00:00Z", "host": "desk",
             "commands": [{"words": ["run", "a.ssd"], "folder": "/tmp"}],
             "sources": [{"what": "the scenario", "path": "/tmp/a.ssd", "sha256": "00"}]},
           "units": [{"component": "a", "state": "serialised"}],
           "states": [{"name": "simulation", "size": 2, "sha256":
             "fb8e20fc2e4c3f248c60c39bd652f3c1347298bb977b8b4d5903b85055620603"}]})"},
         .alphabet = "{}[]\":,0123456789-.eE\\untrfals "},
        {.name = "branches",
         .read = read_branches,
         .seeds = {R"(<b:Branches xmlns:b="urn:org.stride:scenario:1">
<b:Branch name="one"><b:Set variable="a.u" value="1" at="0.5"/>
<b:Force variable="b.u" from="1" until="2"/></b:Branch>
<b:Branch name="two"><b:Drop variable="c.m" from="1"/><b:Delay variable="c.m" time="0.1" from="2"/>
<b:Corrupt variable="c.m" bits="3" header="1" seed="9" from="3" until="4"/></b:Branch>
</b:Branches>)"}},
    });

}  // namespace
}  // namespace stride::tests
