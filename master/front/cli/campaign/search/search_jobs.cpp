#include "master/front/cli/campaign/search/search_jobs.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/message_text.h"
#include "master/front/cli/campaign/cases/missing_cases.h"
#include "master/study/campaign/cases/chunks.h"

namespace stride::cli {
namespace {

using namespace std::chrono_literals;
using campaign::CaseRange;
using Clock = std::chrono::steady_clock;

/// A search waits for its slowest job.
constexpr double kShortestJobs = 0;  // [s]
constexpr std::chrono::milliseconds kLeastSleep = 100ms, kMostSleep = 1s;
/// The workload manager is asked less often than files are looked at.
constexpr std::chrono::seconds kLeastUnasked = 1s, kMostUnasked = 10s;
/// It may be restarted meanwhile.
constexpr int kMostFailedQuestions = 60;
/// A shared folder may show new files late.
constexpr std::chrono::seconds kLateness = 5s;
constexpr std::size_t kShownLogs = 3, kMostNamedCases = 10;

std::string last_line(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) last = line;
  }
  return last;
}

std::vector<std::uint64_t> missing_in(const campaign::CaseFolder& cases, const CaseRange& batch) {
  std::vector<std::uint64_t> missing;
  for (std::uint64_t i = batch.first; i <= batch.last; ++i) {
    if (!cases.read(i)) missing.push_back(i);
  }
  return missing;
}

}  // namespace

SearchJobs::SearchJobs(const SearchArguments& arguments, const CampaignInput& input,
                       std::function<void(const std::string& what)> on_wait)
    : jobs_(arguments.cluster, input.plan().campaign(), input.folder(),
            part_words(arguments, input.folder()), cases_side_by_side(arguments)),
      on_wait_(std::move(on_wait)) {}

JobArray SearchJobs::array(const campaign::CaseFolder& cases, const CaseRange& batch) const {
  const campaign::CaseSurvey survey = campaign::survey(cases, batch.last + 1);
  return jobs_.array(survey, jobs_.length(survey, kShortestJobs));
}

std::string SearchJobs::script(const campaign::CaseFolder& cases, const CaseRange& batch) const {
  return jobs_.cluster().script(array(cases, batch));
}

std::string SearchJobs::text_of(const std::vector<std::string>& ids) const {
  return fmt::format("job {} of {}", fmt::join(ids, ", "), jobs_.cluster().name());
}

bool SearchJobs::run(const campaign::Plan&, const campaign::CaseFolder& cases,
                     const CaseRange& batch) {
  if (!std::exchange(has_looked_for_earlier_, true)) {
    const std::vector<std::string> earlier = jobs_.in_queue();
    if (!earlier.empty() && !wait(earlier, cases, batch)) return false;
  }
  drop_others(cases, batch);
  if (missing_in(cases, batch).empty()) return true;
  const JobArray submitted = array(cases, batch);
  std::string id;
  jobs_.submit(submitted, false, [&](const std::string& given) { id = given; });
  if (!wait({id}, cases, batch)) return false;
  note_lost(id, submitted, cases, batch);
  return lost_.cases.empty();
}

/// Until all records are there or the jobs have ended. False if it was interrupted.
bool SearchJobs::wait(const std::vector<std::string>& ids, const campaign::CaseFolder& cases,
                      const CaseRange& batch) {
  std::vector<std::uint64_t> missing = missing_in(cases, batch);
  std::chrono::milliseconds pause = kLeastSleep;
  std::chrono::seconds silence = kLeastUnasked;
  Clock::time_point question = Clock::now() + silence;
  std::optional<Clock::time_point> end;  // behind that of the jobs
  while (!missing.empty() && (!end || Clock::now() < *end)) {
    if (MissingCases::is_interrupted()) {
      left_ = text_of(ids);
      return false;
    }
    if (!end && Clock::now() >= question) {
      if (!are_in_queue(ids)) end = Clock::now() + kLateness;
      silence = std::min(2 * silence, kMostUnasked);
      question = Clock::now() + silence;
    }
    on_wait_(text_of(ids));
    std::this_thread::sleep_for(pause);
    pause = std::min(pause + pause / 4, kMostSleep);
    std::erase_if(missing, [&](std::uint64_t index) { return cases.read(index).has_value(); });
  }
  return true;
}

bool SearchJobs::are_in_queue(const std::vector<std::string>& ids) {
  try {
    const std::vector<std::string> queued = jobs_.cluster().arrays_in_queue();
    failed_questions_ = 0;
    return std::ranges::find_first_of(queued, ids) != queued.end();
  } catch (const core::Error&) {
    if (++failed_questions_ >= kMostFailedQuestions) throw;
    return true;  // as far as is known
  }
}

void SearchJobs::note_lost(const std::string& id, const JobArray& array,
                           const campaign::CaseFolder& cases, const CaseRange& batch) {
  for (const std::uint64_t index : missing_in(cases, batch)) {
    lost_.cases.push_back(std::to_string(index));
    const auto job = std::ranges::find_if(
        array.ranges, [&](const CaseRange& range) { return index <= range.last; });
    const auto place = static_cast<std::size_t>(job - array.ranges.begin());
    const std::filesystem::path log = jobs_.log_file(id, place);
    if (lost_.logs.empty() || lost_.logs.back() != log) lost_.logs.push_back(log);
  }
}

void SearchJobs::require_records() const {
  if (lost_.cases.empty()) return;
  std::vector<std::string> logs;
  for (const std::filesystem::path& log : lost_.logs) {
    if (core::is_file(log)) logs.push_back(log.string());
  }
  const std::string last = logs.empty() ? "" : last_line(logs.front());
  const bool is_one = lost_.cases.size() == 1;
  core::fail_run(
      {},
      fmt::format("jobs have left the queue of {}, and {} {} no record{}", jobs_.cluster().name(),
                  (is_one ? "case " : "cases ") + core::abridged(lost_.cases, kMostNamedCases),
                  is_one ? "has" : "have",
                  last.empty() ? "" : "; a log file ends with: " + core::name_text(last)),
      fmt::format("{}; the same command submits these cases again",
                  logs.empty() ? "they have no log files, so they were cancelled before they began"
                               : "see " + core::abridged(logs, kShownLogs)));
}

}  // namespace stride::cli
