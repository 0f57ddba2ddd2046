// What results were made from.
#ifndef STRIDE_MASTER_OBSERVE_RECORDERS_PROVENANCE_H
#define STRIDE_MASTER_OBSERVE_RECORDERS_PROVENANCE_H

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "master/base/files/file_digests.h"

namespace stride::recorders {

/// A file, or a folder, that decides what a run does, by its content.
struct Source {
  std::string what;  ///< "the scenario", "a unit of the scenario"
  /// Absolute; of what is on another machine that and its path there, "box:/models/sensor.fmu".
  std::filesystem::path path;
  std::string sha256;  ///< of a folder: of the names and contents of the files in it
  bool operator==(const Source&) const = default;
};

/// What a file with branches is, which decides nothing of a run before they begin: the
/// interventions that come later are compared by themselves.
inline constexpr const char* kBranchesFile = "the file of the branches";

struct Command {
  std::vector<std::string> words;  ///< behind the program's name
  std::filesystem::path folder;    ///< the working folder, absolute
};

/// Ready for a POSIX shell, `stride` included.
std::string shell_text(const std::vector<std::string>& words);

struct Provenance {
  std::string version;  ///< of stride
  std::string date{};   ///< when it began, in UTC: "2026-11-25T23:59:59Z"
  std::string host{};   ///< where
  /// That of the run, and of each time that it was resumed.
  std::vector<Command> commands{};
  std::vector<Source> sources{};
  /// What was other than the scenario has it: units, "component=FILE", and start values,
  /// "component.variable=value".
  std::vector<std::string> swaps{};
  std::vector<std::string> values{};
};

/// Throws core::Error (Input) for what cannot be read.
Source make_source(std::string what, const std::filesystem::path& path, core::FileDigests& digests);

/// For each source that differs, or is missing, but kBranchesFile: in words.
std::vector<std::string> differences(const Provenance& before, const Provenance& now);

nlohmann::ordered_json to_json(const Provenance& provenance);
/// Throws nlohmann::json::exception for what is no provenance.
Provenance provenance_of(const nlohmann::ordered_json& json);

}  // namespace stride::recorders

#endif
