#include "master/front/cli/campaign/cluster/slurm.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/front/cli/campaign/cluster/called_program.h"
#include "master/front/cli/campaign/cluster/slurm_script.h"
#include "master/front/cli/campaign/cluster/slurm_time.h"

namespace stride::cli {
namespace {

/// Neither a script of some megabytes nor half of what the cluster can have in its queue.
constexpr std::uint64_t kLongestArray = 10'000;

[[noreturn]] void fail_to_call(const std::system_error& error) {
  if (error.code() != std::errc::no_such_file_or_directory) {
    core::fail_run({}, fmt::format("cannot run a program of Slurm: {}", error.what()));
  }
  core::fail_input({},
                   "--on slurm: there are no programs of Slurm here (sbatch, squeue, scontrol), as "
                   "those that submit jobs to a cluster have",
                   "submit from a machine of the cluster, or see --case and --cases of 'stride "
                   "campaign run' for other runners");
}

[[noreturn]] void fail_as(const std::string& program, std::string errors) {
  while (!errors.empty() && errors.back() == '\n') errors.pop_back();
  core::fail_run({}, errors.empty() ? fmt::format("{} of Slurm has failed", program)
                                    : fmt::format("{} of Slurm has failed: {}", program, errors));
}

std::vector<std::string> lines_of(std::vector<std::string> words) {
  const std::string program = words.front();
  try {
    ProgramOutput output = output_of(std::move(words));
    if (output.has_failed) fail_as(program, output.errors);
    return std::move(output.lines);
  } catch (const std::system_error& error) {
    fail_to_call(error);
  }
}

/// The number after "NAME = " of `scontrol show config`.
std::optional<std::uint64_t> setting(const std::vector<std::string>& lines,
                                     const std::string& name) {
  for (const std::string& line : lines) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || line.substr(0, line.find(' ')) != name) continue;
    const std::size_t begin = line.find_first_not_of(' ', equals + 1);
    if (begin == std::string::npos) break;
    std::uint64_t number = 0;
    const char* const end = line.data() + line.size();
    if (std::from_chars(line.data() + begin, end, number).ec == std::errc()) return number;
  }
  return std::nullopt;
}

/// Of a line "ID" or "ID;CLUSTER"; empty for another one.
std::string id_in(const std::string& line) {
  const std::string id = line.substr(0, line.find(';'));
  const bool is_number = id.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? id : "";
}

}  // namespace

double Slurm::seconds(const std::string& time) const {
  if (const auto seconds = slurm_seconds(time)) return *seconds;
  core::fail_input({}, fmt::format("--time {}: this is no time of Slurm", time),
                   "write minutes, minutes:seconds, hours:minutes:seconds, days-hours, "
                   "days-hours:minutes or days-hours:minutes:seconds");
}

std::uint64_t Slurm::most_jobs() const {
  const std::vector<std::string> lines = lines_of({"scontrol", "show", "config"});
  const auto array = setting(lines, "MaxArraySize");
  if (!array) core::fail_run({}, "'scontrol show config' of Slurm says no MaxArraySize");
  if (*array == 0) {
    core::fail_input({}, "this cluster takes no job arrays: its MaxArraySize is 0");
  }
  const auto queue = setting(lines, "MaxJobCount");
  const std::uint64_t half = queue ? std::max<std::uint64_t>(*queue / 2, 1) : kLongestArray;
  return std::min({*array, half, kLongestArray});
}

std::vector<std::string> Slurm::arrays_in_queue() const {
  std::vector<std::string> ids = lines_of({"squeue", "--me", "--noheader", "--format=%F"});
  std::ranges::sort(ids);
  ids.erase(std::ranges::unique(ids).begin(), ids.end());
  return ids;
}

std::string Slurm::script(const JobArray& array) const { return slurm_script(array); }

/// sbatch returns the exit code of jobs when it has waited for them, so what tells of its own
/// failure is that it has not submitted them.
void Slurm::submit(const std::filesystem::path& script, bool waits,
                   const std::function<void(const std::string& id)>& is_submitted) const {
  std::vector<std::string> words{"sbatch", "--parsable"};
  if (waits) words.emplace_back("--wait");
  words.push_back(script.string());
  try {
    CalledProgram sbatch(std::move(words));
    std::string id;
    while (const auto line = sbatch.read_line()) {
      if (!id.empty()) continue;
      id = id_in(*line);
      if (!id.empty()) is_submitted(id);
    }
    sbatch.wait();
    if (id.empty()) fail_as("sbatch", sbatch.errors());
  } catch (const std::system_error& error) {
    fail_to_call(error);
  }
}

}  // namespace stride::cli
