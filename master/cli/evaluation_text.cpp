#include "master/cli/evaluation_text.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/algorithm/loops/evaluation_order.h"
#include "master/cli/table.h"

namespace stride::cli {
namespace {

constexpr std::size_t kMostNames = 4;

/// "a, b, c, d and 3 more"
std::string shortened(const std::vector<std::string>& names) {
  const std::size_t shown = names.size() <= kMostNames + 1 ? names.size() : kMostNames;
  std::string text = fmt::format(
      "{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

std::string solved_for(const core::System& system, const core::EvaluationBlock& loop) {
  std::vector<std::string> names;
  for (const core::TearingVariable& variable : loop.tearing_variables) {
    for (const core::VariableId id : variable.inputs) names.push_back(system.full_name(id));
  }
  return shortened(names);
}

std::string loop_text(const core::System& system, const core::EvaluationBlock& loop,
                      const std::string& when) {
  std::string text;
  for (const std::string& path : loop.paths) text += fmt::format("  {}\n", path);
  if (loop.unnamed_paths > 0) text += fmt::format("  and {} more paths\n", loop.unnamed_paths);
  text += fmt::format("    {}, solved for {}\n", when, solved_for(system, loop));
  const std::string undeclared = core::undeclared_text(system, loop);
  if (!undeclared.empty()) {
    text += fmt::format("    {}, so all inputs are taken for them\n", undeclared);
  }
  return text;
}

}  // namespace

std::string initial_order_text(const core::System& system) {
  Table table({{"", Table::Align::Right}, {"component"}, {"outputs"}, {"how"}});
  const auto order = core::evaluation_order(system, core::Phase::Initialization);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const core::EvaluationBlock& block = order[i];
    for (const core::EvaluationStep& step : block.steps) {
      std::vector<std::string> outputs;
      for (const core::VariableId id : step.outputs) outputs.push_back(system.variable(id).name);
      table.add({std::to_string(i + 1), system.components()[step.component].name,
                 shortened(outputs),
                 block.is_loop() ? "loop, solved for " + solved_for(system, block) : "once"});
    }
  }
  return order.empty() ? "  no output is connected\n" : table.text();
}

std::string loops_text(const core::System& system) {
  const auto loops = [&](core::Phase phase) {
    auto order = core::evaluation_order(system, phase);
    order.erase(std::remove_if(order.begin(), order.end(),
                               [](const auto& block) { return !block.is_loop(); }),
                order.end());
    return order;
  };
  const auto initial = loops(core::Phase::Initialization);
  const auto later = loops(core::Phase::Events);
  const auto is_among = [](const core::EvaluationBlock& loop,
                           const std::vector<core::EvaluationBlock>& others) {
    return std::any_of(others.begin(), others.end(),
                       [&](const auto& other) { return other.paths == loop.paths; });
  };
  std::string text;
  for (const core::EvaluationBlock& loop : initial) {
    text += loop_text(system, loop,
                      is_among(loop, later) ? "at the start and at events" : "at the start");
  }
  for (const core::EvaluationBlock& loop : later) {
    if (!is_among(loop, initial)) text += loop_text(system, loop, "at events");
  }
  return text.empty() ? "  none\n" : text;
}

}  // namespace stride::cli
