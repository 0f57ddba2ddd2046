#include "master/study/campaign/candidate_values.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <utility>

namespace stride::campaign {
namespace {

class CandidateCollector {
 public:
  explicit CandidateCollector(const Plan& plan) : plan_(plan) {}

  std::vector<CandidateValue> collected() && {
    if (const auto* const stochastic = std::get_if<Stochastic>(&plan_.campaign().variation)) {
      add_distributions(*stochastic);
    } else {
      for (const Factor& factor : std::get<Deterministic>(plan_.campaign().variation).factors) {
        std::visit([&](const auto& values) { add(values); }, factor);
      }
    }
    return std::move(candidates_);
  }

 private:
  void add_text(std::size_t column, const std::string& text, const core::Location& where) {
    if (known_.emplace(column, text).second) candidates_.push_back({column, text, where, false});
  }

  void add(const ValueTable& table) {
    for (const ValueTable::Row& row : table.rows) {
      for (std::size_t i = 0; i < table.parameters.size(); ++i) {
        if (row.values[i]) add_text(table.parameters[i], *row.values[i], row.where);
      }
    }
  }

  void add(const ValueRange& range) {
    const core::Location& where = plan_.columns()[range.parameter].parameter.where;
    const bool are_texts = plan_.kinds()[range.parameter].type == ValueKind::Type::Text;
    for (std::uint64_t i = 0; i < range.count; ++i) {
      if (!are_texts && i > 1) i = range.count - 1;
      add_text(range.parameter, step_text(range.first, range.step, i), where);
    }
  }

  struct Extreme {
    double number = 0;
    std::string text;
  };
  struct Extremes {
    const StochasticParameter* drawn;
    Extreme least, greatest;
  };

  void add_distributions(const Stochastic& stochastic) {
    std::vector<Extremes> numbers;
    for (const StochasticParameter& drawn : stochastic.parameters) {
      if (const auto* const set = std::get_if<ProbabilitySet>(&drawn.distribution)) {
        for (const auto& element : set->elements) {
          add_text(drawn.parameter, element.value, element.where);
        }
      } else {
        numbers.push_back({&drawn, {}, {}});
      }
    }
    for (std::uint64_t i = 0; !numbers.empty() && i < plan_.size(); ++i) {
      const Case row = plan_.at(i);
      for (Extremes& extremes : numbers) widen(extremes, *row.values[extremes.drawn->parameter]);
    }
    for (const auto& [drawn, least, greatest] : numbers) {
      for (const std::string& text : std::set{least.text, greatest.text}) {
        candidates_.push_back({drawn->parameter, text, drawn->where, true});
      }
    }
  }

  static void widen(Extremes& extremes, const std::string& text) {
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    auto& [drawn, least, greatest] = extremes;
    if (least.text.empty() || number < least.number) least = {number, text};
    if (greatest.text.empty() || number > greatest.number) greatest = {number, text};
  }

  const Plan& plan_;
  std::vector<CandidateValue> candidates_;
  std::set<std::pair<std::size_t, std::string>> known_;
};

}  // namespace

std::vector<CandidateValue> candidate_values(const Plan& plan) {
  return CandidateCollector(plan).collected();
}

}  // namespace stride::campaign
