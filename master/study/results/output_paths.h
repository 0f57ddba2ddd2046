// What a command writes never replaces what it reads, nor another file that it writes.
#ifndef STRIDE_MASTER_STUDY_RESULTS_OUTPUT_PATHS_H
#define STRIDE_MASTER_STUDY_RESULTS_OUTPUT_PATHS_H

#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/observe/recorders/results_folder.h"
#include "master/system/plan/run_plan.h"
#include "master/system/ssp/files.h"

namespace stride::results {

/// A file that the command line names to be written.
struct OutputPath {
  std::string option;  ///< as it is given: "--junit FILE"
  std::filesystem::path file;
};

/// A file, or the folder of an unpacked unit, that no output may replace.
struct KeptPath {
  std::filesystem::path path;
  std::string what;  ///< such as kTheScenario
};

/// What the file of the scenario itself is, or its package.
inline constexpr const char* kTheScenario = "the scenario";

/// What a file is that the command line names for values at the start (--parameters).
inline constexpr const char* kParameters = "a file of parameters";

/// What a scenario consists of.
struct ScenarioFiles {
  std::vector<KeptPath> inputs;      ///< its files and units that exist, and its package
  recorders::ResultFiles results;    ///< the names that it gives to the files of its results
  std::shared_ptr<ssp::Files> read;  ///< the systems in it, for RunPlan
};

/// Reads the sources that a scenario and the systems in it name; `swaps` are "component=FILE". No
/// unit is loaded. It never throws core::Error: what is missing or malformed is left out, since the
/// command itself complains about it.
ScenarioFiles files_of_scenario(const std::filesystem::path& scenario,
                                std::span<const std::string> swaps = {});

/// What a scenario that has been loaded consists of: its files, and its units, of which there may
/// be others than it names (--swap), and the files of parameters that were given with it.
std::vector<KeptPath> inputs_of(const scenario::RunPlan& loaded);

/// Throws core::Error (Input) if a file of the results in this folder is one of these paths, or in
/// one that is a folder.
void refuse_results(const std::filesystem::path& folder, const recorders::ResultFiles& files,
                    std::span<const KeptPath> kept);

/// The files of the results in this folder, whether they exist or not.
std::vector<KeptPath> kept_results(const std::filesystem::path& folder,
                                   const recorders::ResultFiles& files);

/// Throws core::Error (Input) if an output is one of these paths, or in one that is a folder,
/// however it is written and through whatever links. Devices and pipes are never the same file.
void refuse_kept_paths(std::span<const OutputPath> outputs, std::span<const KeptPath> kept);

/// Throws core::Error (Input) if two outputs are the same file.
void refuse_shared_paths(std::span<const OutputPath> outputs);

/// Throws core::Error (Input) if an output is in one of these folders in `root`, which belongs to
/// `owner`: "the results".
void refuse_folders(const OutputPath& output, const std::filesystem::path& root,
                    std::initializer_list<const char*> names, const char* owner);

}  // namespace stride::results

#endif
