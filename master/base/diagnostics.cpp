#include "master/base/diagnostics.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace stride::core {
namespace {

constexpr std::size_t kMostLines = 60;

/// Those about one unit behind its first one.
std::vector<Error> by_unit(const std::vector<Error>& mistakes) {
  std::vector<Error> sorted;
  for (const Error& mistake : mistakes) {
    const auto is_same = [&](const Error& other) {
      return other.context().unit == mistake.context().unit;
    };
    const auto last = std::find_if(sorted.rbegin(), sorted.rend(), is_same);
    sorted.insert(last == sorted.rend() ? sorted.end() : last.base(), mistake);
  }
  return sorted;
}

/// A hint that several share is reported once, behind them all.
std::string shared_hints(const std::vector<Error>& mistakes, std::map<std::string, int>& uses) {
  std::string text;
  for (const Error& mistake : mistakes) {
    int& count = uses[mistake.hint()];
    if (mistake.hint().empty() || count < 2) continue;
    text += (text.empty() ? "" : "\n  hint: ") + mistake.hint();
    count = 0;
  }
  return text;
}

}  // namespace

bool Diagnostics::mentions(const std::string& unit, const std::string& variable) const {
  return std::any_of(kept_.begin(), kept_.end(), [&](const Error& mistake) {
    return mistake.context().unit == unit && mistake.context().variable == variable;
  });
}

void Diagnostics::sum_up(const std::string& unit, Location where, std::string text) {
  summaries_[unit] = {std::move(where), std::move(text)};
}

void Diagnostics::raise_of_unit(const std::string& unit, const std::string& count,
                                const std::string& lines, const std::string& hints) const {
  std::string head = fmt::format("{} things do not fit", count);
  Location where;
  if (const auto summary = summaries_.find(unit); summary != summaries_.end()) {
    where = summary->second.where;
    head += "; " + summary->second.text;
  }
  fail_input({where, unit, {}, {}}, head + ":" + lines, hints);
}

void Diagnostics::raise() const {
  if (kept_.empty()) return;
  if (kept_.size() == 1) throw kept_.front();
  const std::vector<Error> sorted = by_unit(kept_);
  const std::string& unit = sorted.front().context().unit;
  const bool is_of_one_unit = sorted.back().context().unit == unit && !unit.empty();
  std::map<std::string, int> hint_uses;
  for (const Error& mistake : sorted) ++hint_uses[mistake.hint()];
  std::string lines;
  for (std::size_t i = 0; i < std::min(sorted.size(), kMostLines); ++i) {
    const std::string& hint = sorted[i].hint();
    Context context = sorted[i].context();
    if (is_of_one_unit) context.unit.clear();
    lines += fmt::format("\n  {}{}", to_text(context), sorted[i].message());
    if (!hint.empty() && hint_uses[hint] == 1) lines += fmt::format(" ({})", hint);
  }
  if (sorted.size() > kMostLines) {
    lines += fmt::format("\n  … and {} more", sorted.size() - kMostLines);
  }
  const std::string count =
      fmt::format("{}{}", sorted.size() < kMostKept ? "" : "at least ", sorted.size());
  const std::string hints = shared_hints(sorted, hint_uses);
  if (is_of_one_unit) raise_of_unit(unit, count, lines, hints);
  fail_input({}, fmt::format("there are {} mistakes:{}", count, lines), hints);
}

}  // namespace stride::core
