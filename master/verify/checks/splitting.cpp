#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "master/util/time_text.h"
#include "master/verify/checks.h"

namespace stride::verify {
namespace {

/// What the sums of a run may differ by when they are made in another order.
constexpr double kRounding = 1e-9;

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The difference of two values, as a share of `scale`; 1 for what is not a number.
double deviation(const std::string& one, const std::string& other, double scale) {
  if (one == other) return 0;
  const auto here = words(one);
  const auto there = words(other);
  if (here.size() != there.size()) return 1;
  double most = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    char* end = nullptr;
    char* other_end = nullptr;
    const double a = std::strtod(here[i].c_str(), &end);
    const double b = std::strtod(there[i].c_str(), &other_end);
    const bool are_numbers = *end == '\0' && *other_end == '\0';
    if (here[i] == there[i]) continue;
    if (!are_numbers || scale == 0) return 1;
    most = std::max(most, std::abs(a - b) / scale);
  }
  return most;
}

double magnitude(const std::string& text) {
  double most = 0;
  for (const std::string& word : words(text)) {
    most = std::max(most, std::abs(std::strtod(word.c_str(), nullptr)));
  }
  return std::isfinite(most) ? most : 0;
}

std::vector<double> scales(const std::vector<Row>& one, const std::vector<Row>& other) {
  std::vector<double> scales(one.empty() ? 0 : one.front().values.size(), 0.0);
  for (const std::vector<Row>* rows : {&one, &other}) {
    for (const Row& row : *rows) {
      for (std::size_t i = 0; i < scales.size(); ++i) {
        scales[i] = std::max(scales[i], magnitude(row.values[i]));
      }
    }
  }
  return scales;
}

struct Comparison {
  bool is_equal = true;  ///< bit for bit
  double worst = 0;      ///< share of the variable's largest value in the run
  std::string text;      ///< where it is worst
};

Comparison compare(const TestedUnit& tested, const std::vector<Row>& whole,
                   const std::vector<Row>& split) {
  Comparison result;
  if (whole.size() != split.size()) {
    return {false, 1,
            fmt::format("the run has {} points instead of {}", split.size(), whole.size())};
  }
  const std::vector<std::string> names = observed_names(tested);
  const std::vector<double> largest = scales(whole, split);
  for (std::size_t row = 0; row < whole.size(); ++row) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& a = whole[row].values[i];
      const std::string& b = split[row].values[i];
      const double share = deviation(a, b, largest[i]);
      result.is_equal = result.is_equal && a == b;
      if (!(share > result.worst)) continue;
      result.worst = share;
      result.text = fmt::format("at {} s '{}' is {} instead of {}",
                                core::to_text(Duration(whole[row].picoseconds)), names[i], b, a);
    }
  }
  return result;
}

bool is_multiple(Duration size, Duration of) { return size % of == Duration{}; }

/// Why halves of a step have to give what the whole gives; empty if there is no reason.
std::string reason_for_equality(const TestedUnit& tested) {
  const core::UnitDescription& unit = tested.description();
  if (unit.split_invariant) return "though it declares that steps may be split (splitInvariant)";
  const bool is_on_grid = unit.fixed_internal_step && tested.step() % 2 == Duration{} &&
                          is_multiple(tested.step() / 2, *unit.fixed_internal_step);
  if (!is_on_grid) return "";
  return fmt::format("though both are multiples of its fixedInternalStepSize, {} s",
                     core::to_text(*unit.fixed_internal_step));
}

}  // namespace

Finding check_splitting(const Trial& trial) {
  const TestedUnit& tested = trial.tested;
  const core::UnitDescription& unit = tested.description();
  const auto run = [&](Split split) {
    return trial.record({.split = split}).without_events().rows;
  };
  const std::vector<Row> whole = run(Split::None);
  std::string text;
  const auto examine = [&](Split split, const std::string& what, const std::string& reason) {
    const Comparison seen = compare(tested, whole, run(split));
    if (!reason.empty() && seen.worst > kRounding) {
      throw Failure(fmt::format("{} where steps of {} s are split {}, {}", seen.text,
                                core::to_text(tested.step()), what, reason));
    }
    if (!text.empty()) text += "; ";
    if (seen.is_equal) {
      text += fmt::format("{}: the same bits", what);
    } else if (seen.worst <= kRounding) {
      text += fmt::format("{}: the same but for rounding ({:.1e})", what, seen.worst);
    } else {
      text += fmt::format("{}: other values, which nothing excludes ({})", what, seen.text);
    }
  };
  examine(Split::Halves, "into halves", reason_for_equality(tested));
  if (unit.can_vary_step) {
    examine(Split::Uneven, "unevenly", unit.split_invariant ? reason_for_equality(tested) : "");
  } else {
    text += "; it has no canHandleVariableCommunicationStepSize";
  }
  return passed(std::move(text));
}

}  // namespace stride::verify
