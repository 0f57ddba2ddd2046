// Warnings of one kind, of which a file may cause any number.
#ifndef STRIDE_MASTER_BASE_LIMITED_WARNINGS_H
#define STRIDE_MASTER_BASE_LIMITED_WARNINGS_H

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace stride::core {

/// Adds the first warnings of a kind to a list in words, and the number of the others at the end.
class LimitedWarnings {
 public:
  static constexpr std::size_t kMostShown = 20;

  /// `others`: what there are more of, such as "parameters without a component".
  LimitedWarnings(std::vector<std::string>& warnings, std::string others)
      : warnings_(warnings), others_(std::move(others)) {}

  /// Counts one more; returns whether add() is to be called with its text.
  bool count() { return ++count_ <= kMostShown; }
  void add(std::string text) { warnings_.push_back(std::move(text)); }
  /// After the last one.
  void finish() {
    if (count_ <= kMostShown) return;
    warnings_.push_back(fmt::format("… and {} more {}", count_ - kMostShown, others_));
  }

 private:
  std::vector<std::string>& warnings_;
  std::string others_;
  std::size_t count_ = 0;
};

/// Shortens a list likewise.
inline void limit_warnings(std::vector<std::string>& warnings, const std::string& others) {
  std::vector<std::string> shown;
  LimitedWarnings limited(shown, others);
  for (std::string& warning : warnings) {
    if (limited.count()) limited.add(std::move(warning));
  }
  limited.finish();
  warnings = std::move(shown);
}

}  // namespace stride::core

#endif
