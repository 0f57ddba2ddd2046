#include "master/study/compare/compare.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/recorders/results_folder.h"
#include "master/report/results.h"
#include "master/report/run_file.h"
#include "master/study/compare/coverages.h"
#include "master/study/compare/criteria/selection.h"
#include "master/study/compare/json_entries.h"
#include "master/study/compare/signals/recorded_signals.h"
#include "master/study/compare/signals/signals.h"
#include "master/study/compare/streams.h"

namespace stride::compare {
namespace {

namespace fs = std::filesystem;
using File = std::string recorders::ResultFiles::*;

/// One of the folders.
struct Folder {
  fs::path path;
  recorders::ResultFiles files;
  report::RunFile run{};

  explicit Folder(const fs::path& folder) : path(folder), files(report::result_files(folder)) {
    if (has(&recorders::ResultFiles::statistics)) run = report::read_run_file(run_file());
  }

  fs::path file(File which) const { return path / (files.*which); }
  fs::path run_file() const { return file(&recorders::ResultFiles::statistics); }
  bool has(File which) const { return !(files.*which).empty() && core::path_exists(file(which)); }
  RunRecord record() const { return {run.json, run_file()}; }
};

/// Without run.json the types of some columns would be deduced otherwise than they are; those of
/// the other run are tried first. They do not fit where a signal has another type now.
RecordedSignals read_signals(const Folder& folder, const Folder& other) {
  const fs::path file = folder.file(&recorders::ResultFiles::signals);
  if (folder.run.signals.empty() && !other.run.signals.empty()) {
    try {
      return read_recorded_signals(file, other.run.signals);
    } catch (const core::Error&) {  // one that is not about types is thrown again below
    }
  }
  return read_recorded_signals(file, folder.run.signals);
}

std::vector<SignalTolerance> with_golden_tolerances(const fs::path& folder, Settings& settings) {
  const fs::path file = folder / kTolerancesFile;
  std::vector<SignalTolerance> rules;
  if (core::path_exists(file)) rules = read_tolerances(file);
  rules.insert(rules.end(), settings.tolerances.begin(), settings.tolerances.end());
  return rules;
}

bool is_earlier(const Difference& a, const Difference& b) {
  const Time time_a = a.time.value_or(Time::max());
  const Time time_b = b.time.value_or(Time::max());
  return time_a != time_b ? time_a < time_b : a.kind < b.kind;
}

class FolderComparison {
 public:
  FolderComparison(const fs::path& a, const fs::path& b, Settings settings)
      : a_(a),
        b_(b),
        settings_(std::move(settings)),
        selection_(settings_.only, settings_.ignored) {
    comparison_.a = a;
    comparison_.b = b;
    if (settings_.is_golden) settings_.tolerances = with_golden_tolerances(b, settings_);
  }

  Comparison compare() {
    note_unfinished(a_);
    note_unfinished(b_);
    compare_run_files();
    compare_messages();
    compare_events();
    compare_signal_files();
    compare_coverage_files();
    selection_.require_use(std::vector<std::string>(names_.begin(), names_.end()));
    if (comparison_.rows == 0 && comparison_.messages == 0) {
      comparison_.notes.push_back("neither rows of signals nor messages were there to compare");
    }
    std::ranges::stable_sort(comparison_.differences, is_earlier);
    return std::move(comparison_);
  }

 private:
  /// Whether both have the file; that only one has it is a difference, unless a golden B has not.
  bool have_both(File which) {
    const bool has_a = a_.has(which);
    const bool has_b = b_.has(which);
    if (has_a && has_b) return true;
    if (has_a != has_b && (has_b || !settings_.is_golden)) {
      const std::string& name = (has_a ? a_ : b_).files.*which;
      comparison_.differences.push_back(
          {Kind::File, name, {}, has_a ? "present" : "missing", has_b ? "present" : "missing"});
    }
    return false;
  }

  void add(Differences differences) {
    std::ranges::move(differences, std::back_inserter(comparison_.differences));
  }

  void note_cut(const Folder& folder, File which, std::optional<std::size_t> line) {
    if (!line) return;
    comparison_.notes.push_back(fmt::format("{}:{}: the last line was cut off and is left out",
                                            folder.file(which).string(), *line));
  }

  /// Its files end at different times, as they were written from memory.
  void note_unfinished(const Folder& folder) {
    if (json_word(folder.run.json, "outcome") != "running") return;
    comparison_.notes.push_back(
        fmt::format("{}: the run was killed, or goes on: its files end at different times, and it "
                    "has no verdicts",
                    folder.path.string()));
  }

  void compare_run_files() {
    if (!have_both(&recorders::ResultFiles::statistics)) return;
    add(compare_outcomes(a_.record(), b_.record(), settings_));
    comparison_.inputs = compare_inputs(a_.record(), b_.record());
  }

  void compare_messages() {
    constexpr File kEvents = &recorders::ResultFiles::events;
    if (!have_both(kEvents)) return;
    const Streams a = read_messages(a_.file(kEvents));
    const Streams b = read_messages(b_.file(kEvents));
    for (const Streams* streams : {&a, &b}) {
      for (const Streams::Stream& stream : streams->streams) names_.insert(stream.variable);
    }
    comparison_.messages = a.order.size();
    compare(a, b, kEvents);
  }

  /// Runs that step differently are in event mode at other instants.
  void compare_events() {
    constexpr File kActivity = &recorders::ResultFiles::activity;
    if (!have_both(kActivity) || settings_.time_tolerance) return;
    compare(read_events(a_.file(kActivity)), read_events(b_.file(kActivity)), kActivity);
  }

  void compare(const Streams& a, const Streams& b, File which) {
    note_cut(a_, which, a.cut);
    note_cut(b_, which, b.cut);
    add(compare_streams(a, b, settings_.time_tolerance, selection_, a_.files.*which));
  }

  void compare_signal_files() {
    constexpr File kSignals = &recorders::ResultFiles::signals;
    if (!have_both(kSignals)) return;
    const RecordedSignals a = read_signals(a_, b_);
    const RecordedSignals b = read_signals(b_, a_);
    note_cut(a_, kSignals, a.cut);
    note_cut(b_, kSignals, b.cut);
    for (const RecordedSignals* signals : {&a, &b}) {
      for (const report::Column& column : signals->columns) names_.insert(column.name());
    }
    comparison_.signals = static_cast<std::size_t>(std::ranges::count_if(
        a.columns, [&](const report::Column& column) { return selection_.has(column.name()); }));
    comparison_.rows = (settings_.is_golden ? b : a).times.size();
    add(compare_signals(a, b, settings_, selection_, a_.files.signals));
  }

  void compare_coverage_files() {
    constexpr File kCoverage = &recorders::ResultFiles::coverage;
    if (!have_both(kCoverage)) return;
    add(compare_coverages(coverage::read_coverage(a_.file(kCoverage)),
                          coverage::read_coverage(b_.file(kCoverage))));
  }

  const Folder a_;
  const Folder b_;
  Settings settings_;
  const Selection selection_;
  std::set<std::string> names_;  ///< of signals and messages
  Comparison comparison_;
};

}  // namespace

const char* const kNotCompared =
    "dates, wall times, machines, paths, steps and idle times, signals.vcd, report.html, files of "
    "units";

Comparison compare_results(const std::filesystem::path& a, const std::filesystem::path& b,
                           const Settings& settings) {
  return FolderComparison(a, b, settings).compare();
}

}  // namespace stride::compare
