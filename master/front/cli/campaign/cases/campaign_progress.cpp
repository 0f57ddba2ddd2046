#include "master/front/cli/campaign/cases/campaign_progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/text/counted.h"

namespace stride::cli {
namespace {

/// As in the progress of a run.
constexpr std::chrono::milliseconds kRewritten{100};
constexpr std::chrono::seconds kLeastSilence{1}, kMostSilence{30};

std::uint64_t tenth(const campaign::CaseTotals& totals) {
  return totals.cases == 0 ? 10 : 10 * totals.done() / totals.cases;
}

}  // namespace

CampaignProgress::CampaignProgress(ProgressStyle style, const campaign::CaseTotals& totals)
    : form_(Progress::form_of(style)), done_before_(totals.done()), shown_tenth_(tenth(totals)) {}

double CampaignProgress::elapsed() const {
  return std::chrono::duration<double>(Clock::now() - began_).count();
}

bool CampaignProgress::is_due(const campaign::CaseTotals& totals, Clock::time_point now) const {
  const auto silence = now - shown_;
  if (form_ != Progress::Form::Lines) return silence >= kRewritten;
  return silence >= kMostSilence || (silence >= kLeastSilence && tenth(totals) != shown_tenth_);
}

void CampaignProgress::show(const campaign::CaseTotals& totals, const std::string& note) {
  const auto now = Clock::now();
  if (form_ == Progress::Form::Nothing || !is_due(totals, now)) return;
  put(totals, nullptr, note);
  shown_ = now;
  shown_done_ = totals.done();
  shown_tenth_ = tenth(totals);
}

void CampaignProgress::end(const campaign::CaseTotals& totals, const std::string& outcome) {
  const bool is_shown = form_ == Progress::Form::Lines && shown_done_ == totals.done();
  if (form_ == Progress::Form::Nothing || is_shown) return;
  put(totals, &outcome);
  if (form_ == Progress::Form::Rewritten) Progress::put("\n");
}

std::optional<double> CampaignProgress::left(const campaign::CaseTotals& totals) const {
  const std::uint64_t done = totals.done() - done_before_;
  if (done == 0 || totals.missing() == 0) return std::nullopt;
  return elapsed() / static_cast<double>(done) * static_cast<double>(totals.missing());
}

void CampaignProgress::put(const campaign::CaseTotals& totals, const std::string* outcome,
                           const std::string& note) const {
  if (form_ == Progress::Form::Json) return put_json(totals, outcome);
  std::string line = fmt::format("{} of {} done, {} failed", totals.done(),
                                 core::counted(totals.cases, "case"), totals.failed);
  if (!note.empty()) line += ", " + note;
  const auto seconds = outcome == nullptr ? left(totals) : std::nullopt;
  if (seconds) line += fmt::format(", {} left", duration_text(*seconds));
  Progress::put(form_ == Progress::Form::Rewritten ? fmt::format("\r{}\033[K", line) : line + "\n");
}

void CampaignProgress::put_json(const campaign::CaseTotals& totals,
                                const std::string* outcome) const {
  nlohmann::ordered_json object = {{"cases", totals.cases},   {"done", totals.done()},
                                   {"passed", totals.passed}, {"failed", totals.failed},
                                   {"wall_time", elapsed()},  {"left", nullptr}};
  if (const auto seconds = left(totals)) object["left"] = *seconds;
  if (outcome != nullptr) object["outcome"] = *outcome;
  Progress::put(object.dump() + "\n");
}

}  // namespace stride::cli
