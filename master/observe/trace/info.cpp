#include "master/observe/trace/info.h"

#include <algorithm>
#include <utility>

#include "master/observe/trace/compress.h"
#include "master/observe/trace/instants.h"

namespace stride::trace {
namespace {

/// The longest first; of equal ones the first.
bool is_before(const Gap& a, const Gap& b) {
  return a.length() != b.length() ? a.length() > b.length() : a.from < b.from;
}

void add_gap(Info& info, const Gap& gap) {
  constexpr std::size_t kMost = 10;
  if (gap.length() <= info.min_gap) return;
  ++info.gaps;
  const auto place = std::upper_bound(info.longest.begin(), info.longest.end(), gap, is_before);
  info.longest.insert(place, gap);
  if (info.longest.size() > kMost) info.longest.pop_back();
}

std::size_t variables(const Header& header) {
  return static_cast<std::size_t>(
      std::count_if(header.declarations.begin(), header.declarations.end(),
                    [&](const Declaration& one) { return !is_advance_time(header, one); }));
}

/// Where an instant is, in both times.
struct InstantTimes {
  std::int64_t kernel = 0;
  std::int64_t time = 0;
  std::int64_t skipped = 0;

  static InstantTimes of(const Instant& instant) {
    return {instant.stamp, instant.time, instant.skipped};
  }
  Gap to(const InstantTimes& later) const { return {time, later.time, later.skipped - skipped}; }
};

/// Goes through the instants.
class Survey {
 public:
  explicit Survey(Info& info) : info_(info) {}

  void add(const Instant& instant) {
    const InstantTimes times = InstantTimes::of(instant);
    if (times.skipped > last_.skipped) ++info_.skips;
    last_ = times;
    // a comment before the first stamp is at no instant
    if (!instant.has_stamp && instant.changes == 0) return;
    if (!std::exchange(has_begun_, true)) first_ = times;
    info_.kernel_time = times.kernel - first_.kernel;
    info_.true_time = times.time - first_.time;
    if (instant.is_empty) return;
    info_.changes += instant.changes;
    if (info_.instants++ > 0) add_gap(info_, active_.to(times));
    active_ = times;
  }

  /// The end of the trace ends a gap, too.
  void finish() {
    if (info_.instants > 0) add_gap(info_, active_.to(last_));
  }

 private:
  Info& info_;
  bool has_begun_ = false;
  InstantTimes first_;
  InstantTimes active_;  ///< the last one at which something was recorded
  InstantTimes last_;
};

}  // namespace

Info info(const std::filesystem::path& file, std::optional<Duration> min_gap, CutOff cut_off) {
  Reader reader(file, cut_off);
  InstantReader instants(reader, InstantReader::Text::Drop);
  Info info;
  info.timescale = reader.header().timescale;
  info.variables = variables(reader.header());
  info.has_advance_time = instants.advance_time().has_value();
  info.min_gap = min_gap_ticks(reader, min_gap);
  Survey survey(info);
  Instant instant;
  while (instants.next(instant)) survey.add(instant);
  survey.finish();
  info.bytes = reader.bytes_read();
  info.cut = reader.cut();
  return info;
}

}  // namespace stride::trace
