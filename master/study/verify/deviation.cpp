#include "master/study/verify/deviation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::verify {
namespace {

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// The difference of two values, as a share of `scale`; 1 for what is not a number.
double share_of(const std::string& one, const std::string& other, double scale) {
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
    if (!are_numbers) return 1;
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

/// What is far below this is rounding about zero.
constexpr double kSmallestScale = 1e-6;

std::vector<double> scales(const std::vector<Row>& one, const std::vector<Row>& other) {
  std::vector<double> scales(one.empty() ? 0 : one.front().values.size(), kSmallestScale);
  for (const std::vector<Row>* rows : {&one, &other}) {
    for (const Row& row : *rows) {
      for (std::size_t i = 0; i < scales.size(); ++i) {
        scales[i] = std::max(scales[i], magnitude(row.values[i]));
      }
    }
  }
  return scales;
}

}  // namespace

Deviation deviation(const std::vector<std::string>& names, const std::vector<Row>& expected,
                    const std::vector<Row>& seen) {
  Deviation result;
  if (expected.size() != seen.size()) {
    return {false, 1,
            fmt::format("the run has {} points instead of {}", seen.size(), expected.size())};
  }
  const std::vector<double> largest = scales(expected, seen);
  for (std::size_t row = 0; row < expected.size(); ++row) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string& a = expected[row].values[i];
      const std::string& b = seen[row].values[i];
      const double share = share_of(a, b, largest[i]);
      result.is_equal = result.is_equal && a == b;
      if (!(share > result.worst)) continue;
      result.worst = share;
      result.text = fmt::format("at {} s '{}' is {} instead of {}",
                                core::to_text(expected[row].time), names[i], b, a);
    }
  }
  return result;
}

}  // namespace stride::verify
