#include "master/front/cli/campaign/distil/replay_suite.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/output_file.h"
#include "master/front/cli/campaign/distil/replay_run.h"
#include "master/observe/capture/capture.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/recorders/results_folder.h"
#include "master/study/campaign/plan_folder.h"
#include "master/study/replay/device_record.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;
using coverage::CoveredGroup;

constexpr const char* kSignals = "signals.csv";
constexpr const char* kEvents = "events.csv";

constexpr std::string_view kScript = R"(#!/bin/sh
# Plays each case to the device. What follows the name of this script goes to stride, such as
#   --swap DEVICE=NEW.fmu
# STRIDE_PROGRAM is the program, if it is not in the PATH. The exit code is 0 if the device does what it did, also
# where a check is undecided, since --stop has ended the run before.
stride=${STRIDE_PROGRAM:-stride}
here=$(dirname "$0")
code=0
for scenario in "$here"/case_*.ssd; do
  name=$(basename "$scenario" .ssd)
  out=$here/results/$name
  if ! { "$stride" run "$scenario" --quiet --out "$out" "$@"SAME; }; then
    echo "$name: FAILED"
    code=1
  elif grep -q '"passed": *null' "$out/run.json"; then
    echo "$name: undecided"
  else
    echo "$name: passed"
  fi
done
exit $code
)";

constexpr std::string_view kSameBits = R"( &&
    cmp "$here/golden/$name/signals.csv" "$out/signals.csv" &&
    cmp "$here/golden/$name/events.csv" "$out/events.csv")";

std::string script(bool compares_bits) {
  std::string text(kScript);
  constexpr std::string_view kPlace = "SAME";
  return text.replace(text.find(kPlace), kPlace.size(), compares_bits ? kSameBits : "");
}

void write_file(const fs::path& path, const std::string& text) {
  core::OutputFile file(path);
  file.write(text);
  file.close();
}

replay::DeviceRecord record_in(const fs::path& folder, const recorders::ResultFiles& files,
                               const std::string& component, const core::UnitDescription& device) {
  const auto path = [&](const std::string& name) {
    return name.empty() || !core::is_file(folder / name) ? fs::path() : folder / name;
  };
  return replay::read_device_record(path(files.signals), path(files.events), component, device);
}

/// "suite/" is "suite".
fs::path without_slash(fs::path folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

bool has_same_bytes(const fs::path& a, const fs::path& b) {
  return core::read_input(a) == core::read_input(b);
}

}  // namespace

std::string replay_name(const campaign::Plan& plan, std::uint64_t index) {
  return "case_" + campaign::case_name(plan, index);
}

ReplaySuite::ReplaySuite(const CampaignInput& input, const campaign::CaseFolder& cases,
                         fs::path folder, const Options& options)
    : input_(input),
      cases_(cases),
      folder_(without_slash(std::move(folder))),
      fresh_(folder_.string() + ".stride-new"),
      options_(options),
      files_(fresh_) {
  if (core::path_exists(folder_) &&
      (!core::is_folder(folder_) || !core::folder_entries(folder_).empty())) {
    core::fail_input({.where = {folder_.string(), 0}}, "there is something in the way of the suite",
                     "choose a folder that is not there, or remove this one");
  }
  recorders::make_results_folder(fresh_);
  lock_.emplace(fresh_);
  for (const fs::path& left : core::folder_entries(fresh_)) fs::remove_all(left);
}

ReplaySuite::~ReplaySuite() {
  std::error_code ignored;
  fs::remove_all(fresh_, ignored);
}

fs::path ReplaySuite::golden(const std::string& name) const { return fresh_ / "golden" / name; }

std::optional<std::string> ReplaySuite::add(std::uint64_t index,
                                            const campaign::CaseResult& result) {
  const std::string name = replay_name(input_.plan(), index);
  const scenario::RunPlan loaded = input_.load_case(index);
  const replay::ReplaySource source{loaded, loaded.system().find_component(options_.component, {}),
                                    input_.folder() / cases_.stimuli_name(index) /
                                        capture::stimuli_file_name(options_.component)};
  std::optional<std::string> why;
  try {
    files_.write(name, source);
    why = why_unlike(index, source, result);
  } catch (const core::Error& mistake) {
    if (mistake.kind() != core::Error::Kind::Input) throw;
    why = mistake.what();
  }
  if (why) {
    drop(name);
  } else {
    added_[index] = result.has_results;
  }
  return why;
}

std::optional<std::string> ReplaySuite::why_unlike(std::uint64_t index,
                                                   const replay::ReplaySource& source,
                                                   const campaign::CaseResult& result) {
  const std::string name = replay_name(input_.plan(), index);
  const std::string device = replay::device_name(options_.component);
  const core::UnitDescription& description =
      *source.loaded.system().components()[source.component].description;
  ReplayRun run{files_.system_file(name), golden(name), device, fresh_ / "stimuli"};
  if (auto why = run_replay(run)) return why;
  if (auto why = why_received_other(source)) return why;
  const replay::DeviceRecord record = record_in(run.results, {}, device, description);
  if (auto why = why_covered_other(run.results, result)) return why;
  if (result.has_results) {
    const auto difference = replay::first_difference(
        record_in(input_.folder() / cases_.results_name(index),
                  source.loaded.scenario().annotation.results, options_.component, description),
        record, replay::summarise_stimuli(source.stimuli));
    if (difference) return fmt::format("it does not do what it did in the case: {}", *difference);
  }
  files_.expect(name, source, replay::expectations_of(record, description, options_.tolerance));
  run.results = fresh_ / "again";
  if (auto why = run_replay(run)) return why;
  for (const char* file : {kSignals, kEvents}) {
    if (has_same_bytes(golden(name) / file, run.results / file)) continue;
    return fmt::format("it does not do the same twice: {} is another", file);
  }
  for (const fs::path& file : core::folder_entries(golden(name))) {
    const fs::path name_only = file.filename();
    if (name_only != kSignals && name_only != kEvents && name_only != coverage::kCoverageFile) {
      fs::remove_all(file);
    }
  }
  return std::nullopt;
}

std::optional<std::string> ReplaySuite::why_received_other(
    const replay::ReplaySource& source) const {
  const fs::path again =
      fresh_ / "stimuli" / capture::stimuli_file_name(replay::device_name(options_.component));
  if (replay::repeated_part(again) == replay::repeated_part(source.stimuli)) return std::nullopt;
  return "the device does not receive the same at the same times when it is alone";
}

/// A case that did not come to its end may have covered more than is in its stimuli.
std::optional<std::string> ReplaySuite::why_covered_other(
    const fs::path& results, const campaign::CaseResult& result) const {
  using campaign::Outcome;
  const bool is_whole = result.outcome == Outcome::Passed || result.outcome == Outcome::Failed;
  if (!is_whole || !result.coverage) return std::nullopt;
  const auto of_case =
      std::ranges::find(result.coverage->bins, options_.component, &CoveredGroup::component);
  if (of_case == result.coverage->bins.end()) return std::nullopt;
  const coverage::CoveredBins again =
      coverage::covered_bins(coverage::read_coverage(results / coverage::kCoverageFile));
  for (const coverage::CoveredPoint& point : of_case->points) {
    const auto& points = again.at(0).points;
    const auto found = std::ranges::find(points, point.name, &coverage::CoveredPoint::name);
    if (found != points.end() && *found == point) continue;
    return fmt::format("it does not cover what it covered in the case: '{}'", point.name);
  }
  return std::nullopt;
}

void ReplaySuite::drop(const std::string& name) {
  std::error_code ignored;
  fs::remove_all(golden(name), ignored);
  files_.remove(name);
}

void ReplaySuite::publish(const std::set<std::uint64_t>& kept, const std::string& page) {
  std::set<std::string> names;
  for (const auto& [index, is_compared] : added_) {
    const std::string name = replay_name(input_.plan(), index);
    if (kept.contains(index)) {
      names.insert(name);
    } else {
      drop(name);
    }
  }
  files_.keep_units_of(names);
  fs::remove_all(fresh_ / "again");
  fs::remove_all(fresh_ / "stimuli");
  write_file(fresh_ / "README.md", page);
  write_file(fresh_ / "run.sh", script(options_.tolerance.empty()));
  fs::permissions(fresh_ / "run.sh", fs::perms::owner_exec | fs::perms::group_exec,
                  fs::perm_options::add);
  std::error_code error;
  fs::rename(fresh_, folder_, error);
  if (!error) return;
  core::fail_run({.where = {folder_.string(), 0}},
                 fmt::format("the suite cannot be put here: {}", error.message()),
                 "see to the folder and its disk");
}

}  // namespace stride::cli
