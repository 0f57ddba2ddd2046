#include "master/study/results/output_paths.h"

#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/xml/document.h"
#include "master/system/declaration/annotation.h"
#include "master/system/plan/split_option.h"
#include "master/system/scenario/units/unit_path.h"
#include "master/system/ssp/ssp.h"
#include "master/system/ssp/uri.h"

namespace stride::results {
namespace {

namespace fs = std::filesystem;

bool is_device_or_pipe(const fs::path& path) {
  return core::path_exists(path) && !core::is_file(path) && !core::is_folder(path);
}

bool is_same_file(const fs::path& one, const fs::path& other) {
  if (is_device_or_pipe(one) || is_device_or_pipe(other)) return false;
  std::error_code error;  // where one of them does not exist
  if (fs::equivalent(one, other, error) && !error) return true;
  return recorders::resolved(one) == recorders::resolved(other);
}

bool is_kept(const fs::path& output, const fs::path& kept) {
  if (is_same_file(output, kept)) return true;
  return core::is_folder(kept) && !is_device_or_pipe(output) &&
         recorders::is_below(recorders::resolved(output), recorders::resolved(kept));
}

constexpr const char* kAUnit = "a unit of the scenario";

/// Collects what a scenario reads, each file once.
class SourceReader {
 public:
  void add_scenario(const fs::path& scenario) {
    if (core::is_file(scenario)) keep(scenario, kTheScenario);
    try {
      const fs::path file = files().scenario_file(scenario);
      const auto package = files().archive_of(file);
      keep(package ? package->path : file, kTheScenario);
      known_.insert(file);
      const xml::Document& document = files().read_ahead(file);
      add_sources(document.root(), ssp::source_folders(file));
      found_.results = scenario::read_annotation(document.root()).results;
    } catch (const core::Error&) {  // reported where the scenario is read
    }
  }

  void add_unit(const fs::path& source) {
    try {
      keep(scenario::find_unit(source, {}), kAUnit);
    } catch (const core::Error&) {  // likewise
    }
  }

  ScenarioFiles found() && { return std::move(found_); }

 private:
  void keep(const fs::path& path, const std::string& what) {
    if (core::path_exists(path)) found_.inputs.push_back({path, what});
  }

  void add_sources(const xml::Element& element, std::span<const fs::path> folders) {
    const std::string source = xml::without_blanks(element.attribute_or("source"));
    const bool names_a_file = !source.empty() && !source.starts_with('#');  // a system of this one
    if (names_a_file) add_source(element, folders);
    for (const xml::Element& child : element.children()) add_sources(child, folders);
  }

  void add_source(const xml::Element& element, std::span<const fs::path> folders) {
    try {
      const fs::path file = ssp::source_of(element, folders).path;
      if (!known_.insert(file).second) return;
      const bool is_system = file.extension() == ".ssd" || file.extension() == ".ssp";
      const bool is_component = element.is(ssp::kSsd, "Component") && !is_system;
      if (is_component || file.extension() == ".fmu") return add_unit(file);
      keep(file, "a file of the scenario");
      if (file.extension() != ".ssd") return;
      const xml::Element root = files().read_ahead(file).root();
      add_sources(root, ssp::source_folders(file));
    } catch (const core::Error&) {  // likewise
    }
  }

  ssp::Files& files() { return *found_.read; }

  std::set<fs::path> known_;
  ScenarioFiles found_{{}, {}, std::make_shared<ssp::Files>(scenario::find_unit)};
};

}  // namespace

ScenarioFiles files_of_scenario(const fs::path& scenario, std::span<const std::string> swaps) {
  SourceReader reader;
  reader.add_scenario(scenario);
  for (const std::string& swap : swaps) {
    if (const auto parts = scenario::split_existing_file("--swap", swap))
      reader.add_unit(parts->file);
  }
  return std::move(reader).found();
}

std::vector<KeptPath> inputs_of(const scenario::RunPlan& loaded) {
  const scenario::Scenario& scenario = loaded.scenario();
  const fs::path system = scenario.files->scenario_file(scenario.path);
  const auto package = scenario.files->archive_of(system);
  std::vector<KeptPath> inputs;
  for (const fs::path& file : scenario.files->documents()) {
    const auto archive = scenario.files->archive_of(file);
    const bool is_scenario = archive && package ? archive->path == package->path : file == system;
    inputs.push_back(
        {archive ? archive->path : file, is_scenario ? kTheScenario : "a file of the scenario"});
  }
  std::set<fs::path> units;
  for (const auto& fmu : loaded.fmus()) units.insert(fmu->path());
  for (const fs::path& unit : units) inputs.push_back({unit, kAUnit});
  for (const fs::path& file : loaded.changes().parameter_files) {
    if (core::is_file(file)) inputs.push_back({file, kParameters});  // a pipe has been read
  }
  return inputs;
}

void refuse_results(const fs::path& folder, const recorders::ResultFiles& files,
                    std::span<const KeptPath> kept) {
  std::vector<OutputPath> results;
  for (const KeptPath& result : kept_results(folder, files)) {
    results.push_back({fmt::format("{} in the results folder {}", result.path.filename().string(),
                                   folder.string()),
                       result.path});
  }
  refuse_kept_paths(results, kept);
}

std::vector<KeptPath> kept_results(const fs::path& folder, const recorders::ResultFiles& files) {
  std::vector<KeptPath> kept;
  for (const auto& [what, member] : recorders::kResultFiles) {
    const std::string& name = files.*member;
    if (!name.empty()) kept.push_back({folder / name, "a file of the results of this run"});
  }
  return kept;
}

void refuse_kept_paths(std::span<const OutputPath> outputs, std::span<const KeptPath> kept) {
  for (const OutputPath& output : outputs) {
    for (const KeptPath& input : kept) {
      if (!is_kept(output.file, input.path)) continue;
      core::fail_input({},
                       fmt::format("{}: this is {}{}", output.option,
                                   core::is_folder(input.path) ? "in " : "", input.what),
                       "choose another file, which may be overwritten");
    }
  }
}

void refuse_shared_paths(std::span<const OutputPath> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_same_file(outputs[i].file, outputs[j].file)) continue;
      core::fail_input(
          {}, fmt::format("{} and {} name the same file", outputs[j].option, outputs[i].option),
          "name another file for one of them; as it is, the file is written twice");
    }
  }
}

void refuse_folders(const OutputPath& output, const fs::path& root,
                    std::initializer_list<const char*> names, const char* owner) {
  const fs::path file = recorders::resolved(output.file);
  for (const char* const name : names) {
    if (!recorders::is_below(file, recorders::resolved(root / name))) continue;
    core::fail_input(
        {}, fmt::format("{}: this is in the folder '{}' of {}", output.option, name, owner),
        "choose a file elsewhere");
  }
}

}  // namespace stride::results
