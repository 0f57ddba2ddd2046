#include "master/study/compare/outcomes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "master/study/compare/criteria/tolerances.h"
#include "master/study/compare/json_entries.h"

namespace stride::compare {
namespace {

using report::Json;

/// Times of run.json are numbers of seconds, or there is none.
std::optional<Time> time_of(const Json& object, const char* member) {
  const Json& found = json_member(object, member);
  if (!found.is_number() || !(std::abs(found.get<double>()) <= kMaxSeconds)) return std::nullopt;
  return time_from_seconds(found.get<double>());
}

bool are_near(std::optional<Time> a, std::optional<Time> b, Duration tolerance) {
  if (!a || !b) return a == b;
  return std::chrono::abs(*a - *b) <= tolerance;
}

std::optional<Time> earlier(std::optional<Time> a, std::optional<Time> b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

class OutcomeComparison {
 public:
  OutcomeComparison(const RunRecord& a, const RunRecord& b, const Settings& settings)
      : a_(a),
        b_(b),
        is_exact_(!settings.time_tolerance &&
                  Tolerances(settings.tolerance, settings.tolerances).are_exact()),
        time_tolerance_(settings.time_tolerance.value_or(Duration())) {}

  Differences differences() {
    compare_ends();
    compare_lists("verdicts", "component", Kind::Verdict);
    compare_lists("checks", "name", Kind::Check);
    return std::move(differences_);
  }

 private:
  void compare_ends() {
    const auto reached_a = time_of(a_.json, "reached");
    const auto reached_b = time_of(b_.json, "reached");
    const auto time = earlier(reached_a, reached_b);
    if (!compare_words("outcome", time)) return;
    if (!are_near(reached_a, reached_b, time_tolerance_)) {
      differences_.push_back({Kind::Outcome, "reached", time, json_word(a_.json, "reached") + " s",
                              json_word(b_.json, "reached") + " s"});
    }
    compare_words("error", time);
  }

  bool compare_words(const char* member, std::optional<Time> time) {
    std::string a = json_word(a_.json, member);
    std::string b = json_word(b_.json, member);
    if (a == b) return true;
    differences_.push_back({Kind::Outcome, member, time, std::move(a), std::move(b)});
    return false;
  }

  /// The nth of a name with the nth.
  void compare_lists(const char* list, const char* name, Kind kind) {
    std::map<std::string, std::pair<std::vector<const Json*>, std::vector<const Json*>>> pairs;
    for (const Json* entry : json_entries(a_.json, list, a_.file)) {
      pairs[json_word(*entry, name)].first.push_back(entry);
    }
    for (const Json* entry : json_entries(b_.json, list, b_.file)) {
      pairs[json_word(*entry, name)].second.push_back(entry);
    }
    for (const auto& [what, entries] : pairs) {
      const auto& [a, b] = entries;
      for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
        static const Json kNone = Json::object();
        compare_verdict(kind, what, i < a.size() ? *a[i] : kNone, i < b.size() ? *b[i] : kNone);
      }
    }
  }

  void compare_verdict(Kind kind, const std::string& what, const Json& a, const Json& b) {
    const auto time_a = time_of(a, "time");
    const auto time_b = time_of(b, "time");
    bool differs = a.empty() != b.empty() || json_word(a, "passed") != json_word(b, "passed") ||
                   !are_near(time_a, time_b, time_tolerance_);
    for (const char* member : {"text", "margin", "values"}) {
      differs = differs || (is_exact_ && json_word(a, member) != json_word(b, member));
    }
    if (!differs) return;
    differences_.push_back({kind, what, earlier(time_a, time_b), in_words(a, b), in_words(b, a)});
  }

  /// What tells it from the other one.
  static std::string in_words(const Json& verdict, const Json& other) {
    if (verdict.empty()) return "none";
    const std::string passed = json_word(verdict, "passed");
    const std::string word =
        passed == "true" ? "passed" : (passed == "false" ? "failed" : "undecided");
    const std::string text = json_word(verdict, "text");
    if (text != json_word(other, "text")) return text.empty() ? word : word + ": " + text;
    if (passed != json_word(other, "passed")) return word;
    const std::string time = json_word(verdict, "time");
    if (time != json_word(other, "time")) return fmt::format("{} at {} s", word, time);
    return fmt::format("{}, margin {}", word, json_word(verdict, "margin"));
  }

  const RunRecord a_;
  const RunRecord b_;
  const bool is_exact_;
  const Duration time_tolerance_;
  Differences differences_;
};

}  // namespace

Differences compare_outcomes(const RunRecord& a, const RunRecord& b, const Settings& settings) {
  return OutcomeComparison(a, b, settings).differences();
}

}  // namespace stride::compare
