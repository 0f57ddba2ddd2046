// Scenarios as `stride check` reads them, with their units, and what the command line adds.
#include <sstream>

#include "master/system/plan/run_plan.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

constexpr const char* kFolder = "loaded/";

/// A unit without its library, which nothing loads.
void place_unit(const std::string& name, const std::string& platform) {
  const std::string folder = kFolder + name;
  copy_seed("model_description/" + name + ".xml", folder + "/modelDescription.xml");
  const std::string library = folder + "/binaries/" + platform + "/" + name + ".so";
  if (!std::filesystem::exists(working_path(library))) write_file(library, "not a library");
}

void place_units() {
  place_unit("types", "x86_64-linux");
  place_unit("fmi2_relaxation", "linux64");
}

void load(const scenario::ScenarioRequest& request) {
  refusing_input("", [&] {
    const scenario::RunPlan loaded(request);
    ensure(loaded.fmus().size() == loaded.system().components().size(), "all units are there");
  });
}

void load_scenario(const std::string& bytes) {
  place_units();
  scenario::ScenarioRequest request;
  request.scenario = write_file(std::string(kFolder) + "x.ssd", bytes);
  load(request);
}

/// Each line is an option: its name, a blank, its value.
void read_command_line(const std::string& bytes) {
  place_units();
  scenario::ScenarioRequest request;
  request.scenario = copy_seed("scenario/wired.ssd", std::string(kFolder) + "wired.ssd");
  std::istringstream lines(bytes);
  for (std::string name, value; lines >> name && std::getline(lines >> std::ws, value);) {
    if (name == "set") request.sets.push_back(value);
    if (name == "signals") request.signals.push_back(value);
    if (name == "stop") request.stop = value;
    if (name == "max-skip") request.max_skip = value;
    if (name == "isolate") request.hosts.hosted.push_back(value);
    if (name == "unit-timeout") request.hosts.unit_timeout = value;
  }
  load(request);
}

const Registration kScenarioParsers(
    "scenario",
    {
        {.name = "run_plan", .read = load_scenario, .seed_files = {"tests/fuzz/seeds/scenario"}},
        {.name = "command_line",
         .read = read_command_line,
         .seeds = {"set a.float64=0.5\nsignals a.*\nstop 3\n",
                   "set b.words=x y\nset a.boolean=true\nset a.colour=red\nset a.binary=00ff\n",
                   "set a.matrix=1 2 3 4 5 6\nset c.k=3\nmax-skip 1\n",
                   "isolate *\nunit-timeout 0.5\nset a.int8=-128\nsignals b.float64.echo\n"},
         .alphabet = "0123456789.=*?[]-e \n"},
    });

}  // namespace
}  // namespace stride::tests
