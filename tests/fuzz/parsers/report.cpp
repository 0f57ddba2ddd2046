// What a report is made of.
#include "master/report/results.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

struct File {
  const char* name;
  const char* seed;
};

constexpr File kFiles[] = {{"run.json", "run_json/run.json"},
                           {"signals.csv", "signals/signals.csv"},
                           {"events.csv", "events/events.csv"},
                           {"activity.csv", "activity/activity.csv"},
                           {"units/world/film/frames.csv", "film/frames.csv"},
                           {"units/world/world.glb", "world/world.glb"}};

/// A folder of results in which this file is another one.
std::filesystem::path results_with(const std::string& name, const std::string& bytes) {
  const std::string folder = "results/" + name + "/";
  for (const File& file : kFiles) {
    if (file.name != name) copy_seed(file.seed, folder + file.name);
  }
  for (const char* picture : {"0.jpg", "1.jpg"}) {
    write_file(folder + "units/world/film/" + picture, "");
  }
  write_file(folder + name, bytes);
  return working_path(folder);
}

template <std::size_t file>
void read_results(const std::string& bytes) {
  const auto folder = results_with(kFiles[file].name, bytes);
  refusing<core::Error>((folder / kFiles[file].name).string() + ":", [&] {
    const report::Results results =
        report::read_results(folder, {}, {.signals = {.values = 20}, .messages = 3});
    for (const report::Column& column : results.signals.columns) {
      ensure(column.size() == results.signals.times.size(), "columns have a value for each time");
    }
    for (const report::UnitActivities& activities : results.activities) {
      ensure(activities.from.size() == activities.until.size(), "what begins has an end");
    }
    for (const report::Film& film : results.films) {
      ensure(film.times.size() == film.pictures.size(), "pictures have times");
    }
    for (const std::string& note : results.notes) {
      const bool is_about = note.starts_with(std::string(kFiles[file].name) + ":");
      const bool is_refused = note.find("left out") != std::string::npos;
      if (is_about && is_refused) {  // rows, or the file
        core::fail_input({.where = {(folder / kFiles[file].name).string(), 0}}, note);
      }
    }
  });
}

/// By itself, since a broken one is left out of a report.
void read_run_json(const std::string& bytes) {
  write_file("run/run.json", bytes);
  const auto path = working_path("run/run.json");
  refusing<core::Error>(path.string() + ":", [&] { report::read_run_file(path); });
}

constexpr const char* kResultsAlphabet = ",\"\n.0123456789-e[]{}:truefalsn";

const Registration kReportParsers("report", {
                                                {.name = "run_json",
                                                 .read = read_run_json,
                                                 .seed_files = {"tests/fuzz/seeds/run_json"},
                                                 .alphabet = kResultsAlphabet},
                                                {.name = "signals",
                                                 .read = read_results<1>,
                                                 .seed_files = {"tests/fuzz/seeds/signals"},
                                                 .alphabet = kResultsAlphabet},
                                                {.name = "events",
                                                 .read = read_results<2>,
                                                 .seed_files = {"tests/fuzz/seeds/events"},
                                                 .alphabet = kResultsAlphabet},
                                                {.name = "activity",
                                                 .read = read_results<3>,
                                                 .seed_files = {"tests/fuzz/seeds/activity"},
                                                 .alphabet = kResultsAlphabet},
                                                {.name = "film",
                                                 .read = read_results<4>,
                                                 .seed_files = {"tests/fuzz/seeds/film"},
                                                 .alphabet = kResultsAlphabet},
                                                {.name = "world",
                                                 .read = read_results<5>,
                                                 .seed_files = {"tests/fuzz/seeds/world"},
                                                 .alphabet = kResultsAlphabet},
                                            });

}  // namespace
}  // namespace stride::tests
