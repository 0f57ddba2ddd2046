#include "master/front/cli/run/checkpoints.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/parse_option.h"
#include "master/base/time_text.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNamed = "checkpoint_";
constexpr std::string_view kLatest = "latest_";
constexpr std::string_view kEnding = "s.zip";
constexpr std::size_t kLatestKept = 2;

/// The simulated time in the name of a checkpoint.
std::optional<Time> time_in(const fs::path& file) {
  std::string name = file.filename().string();
  const auto prefix = name.starts_with(kNamed) ? kNamed : kLatest;
  if (!name.starts_with(prefix) || !name.ends_with(kEnding)) return std::nullopt;
  name = name.substr(prefix.size(), name.size() - prefix.size() - kEnding.size());
  try {
    return core::parse_time(name);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

}  // namespace

void add_checkpoint_options(CLI::App& command, CheckpointTimes& times) {
  command
      .add_option_function<std::vector<std::string>>(
          "--checkpoint",
          [&times](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) {
              times.at.push_back(core::parse_option("--checkpoint", text, core::parse_time));
            }
          },
          "Write the state of the run at this simulated time, for 'stride resume'; may be given "
          "several times")
      ->type_name("SECONDS")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--checkpoint-every",
          [&times](const std::string& text) {
            times.every = core::parse_option("--checkpoint-every", text, core::parse_seconds);
          },
          "Likewise, each time that so much simulated time has passed, and where a signal ends the "
          "run; the last two stay")
      ->type_name("SECONDS");
  command.add_flag("--checkpoint-on-signal", times.on_signal,
                   "Likewise where SIGINT (Ctrl-C), SIGTERM or SIGHUP ends the run");
}

std::vector<fs::path> checkpoints_in(const fs::path& results) {
  std::vector<std::pair<Time, fs::path>> found;
  for (const fs::path& file : core::folder_entries(results / kCheckpointsFolder)) {
    if (const auto time = time_in(file)) found.emplace_back(*time, file);
  }
  std::ranges::stable_sort(found);
  std::vector<fs::path> files;
  for (auto& [time, file] : found) files.push_back(std::move(file));
  return files;
}

void remove_checkpoints(const fs::path& results) {
  std::error_code ignored;  // what cannot be removed fails where it is to be replaced
  for (const fs::path& file : checkpoints_in(results)) fs::remove(file, ignored);
  fs::remove(results / kCheckpointsFolder, ignored);
}

Checkpoints::Checkpoints(CheckpointTimes times, const Span& span, fs::path results, Take take)
    : times_(std::move(times)),
      start_(span.start),
      results_(std::move(results)),
      take_(std::move(take)) {
  for (const Time time : times_.at) {
    if (time >= span.start && time <= span.stop) continue;
    core::fail_input(
        {}, fmt::format("--checkpoint {}: the run is from {} s to {} s", core::to_text(time),
                        core::to_text(span.start), core::to_text(span.stop)));
  }
  if (times_.every && *times_.every <= Duration{}) {
    core::fail_input({}, fmt::format("--checkpoint-every {}: expected a time above 0",
                                     core::to_text(*times_.every)));
  }
  std::ranges::sort(times_.at);
  const bool is_resumed = span.begin > span.start;
  std::erase_if(times_.at, [&](Time time) { return is_resumed && time <= span.begin; });
  if (times_.every) periodic_ = next_periodic(span.begin);
}

std::optional<core::Pause> Checkpoints::next(Time /*now*/) {
  std::optional<Time> next = periodic_;
  if (!times_.at.empty()) next = std::min(times_.at.front(), next.value_or(times_.at.front()));
  if (!next) return std::nullopt;
  return core::Pause{*next};
}

void Checkpoints::on_pause(Time now) {
  const std::size_t named = times_.at.size();
  std::erase_if(times_.at, [&](Time time) { return time <= now; });
  if (times_.at.size() < named) write(now, kNamed.data());
  if (!periodic_ || *periodic_ > now) return;
  periodic_ = next_periodic(now);
  if (write(now, kLatest.data()).empty()) return;
  drop_older();
}

void Checkpoints::on_interruption(Time now) {
  if (!times_.on_signal && !times_.every) return;
  at_interruption_ = write(now, kLatest.data());
}

/// Behind this time.
Time Checkpoints::next_periodic(Time now) const {
  const Duration every = *times_.every;
  return later(now, every - (now - start_) % every);
}

/// Returns the file; an empty path where it could not be written.
fs::path Checkpoints::write(Time now, const char* prefix) {
  const checkpoint::Checkpoint taken = take_(now);
  const fs::path file =
      results_ / kCheckpointsFolder / fmt::format("{}{}{}", prefix, core::to_text(now), kEnding);
  try {
    std::error_code ignored;  // then the file cannot be written
    fs::create_directory(file.parent_path(), ignored);
    checkpoint::write_checkpoint(file, taken);
    return file;
  } catch (const core::Error& failure) {
    failures_.push_back(core::to_text(now));
    spdlog::warn("the checkpoint at {} s was not written, and the run goes on: {}",
                 core::to_text(now), failure.what());
    return {};
  }
}

/// When a new one is complete.
void Checkpoints::drop_older() const {
  std::vector<fs::path> latest = checkpoints_in(results_);
  std::erase_if(
      latest, [](const fs::path& file) { return !file.filename().string().starts_with(kLatest); });
  std::error_code ignored;
  for (std::size_t i = 0; i + kLatestKept < latest.size(); ++i) fs::remove(latest[i], ignored);
}

void Checkpoints::require_all() const {
  if (failures_.empty()) return;
  core::fail_run({}, fmt::format("the run is complete, but its state at {} s was not written; "
                                 "warnings say why",
                                 fmt::join(failures_, ", ")));
}

}  // namespace stride::cli
