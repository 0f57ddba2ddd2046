#include "master/engine/run/loops/algebraic_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stride::core {
namespace {

/// Rounds in which values other than floating-point numbers may change.
constexpr int kMostRounds = 100;
constexpr std::size_t kMostValues = 8;  // in a message

/// Returns whether the value changes.
bool change_real(const ValueSlice& slice, std::size_t element, double value) {
  const double before = real(slice, element);
  set_real(slice, value, element);
  return real(slice, element) != before;
}

/// Values that are not finite are not passed to units.
bool is_finite(const ValueBlock& block) {
  if (!is_real(block.type())) return true;
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (!std::isfinite(real(block, i))) return false;
  }
  return true;
}

/// The precision of the numbers that run through the loop.
double epsilon(const System& system, const EvaluationBlock& plan) {
  const auto is_coarse = [&](VariableId id) {
    return system.variable(id).type == ValueType::Float32;
  };
  bool coarse = std::ranges::any_of(plan.inputs, is_coarse);
  for (const OutputGroup& group : plan.groups) {
    coarse |= std::ranges::any_of(group.outputs, is_coarse);
  }
  return coarse ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
}

}  // namespace

AlgebraicLoop::AlgebraicLoop(RunContext& context, const EvaluationBlock& plan,
                             OrderedExchange& exchange)
    : system_(context.system), plan_(plan), exchange_(exchange) {
  if (LoopDerivatives::exist(system_, plan)) derivatives_.emplace(system_, context.units, plan);
  scale_.epsilon = epsilon(system_, plan);
  for (const TearingVariable& variable : plan.tearing_variables) {
    const Variable& input = system_.variable(variable.inputs.front().id);
    Tear tear{&variable,
              context.exchange.slice(variable.source),
              {},
              ValueBlock(input.type, variable.source.size),
              is_real(input.type)};
    for (const ElementRange& to : variable.inputs) tear.links.push_back(exchange.plan_link(to));
    for (std::size_t i = 0; i < variable.source.size; ++i) {
      unknowns_.push_back({tears_.size(), i});
      if (!tear.is_real) continue;
      reals_.push_back({tears_.size(), i});
      scale_.nominals.push_back(input.nominal);
    }
    tears_.push_back(std::move(tear));
  }
}

void AlgebraicLoop::guess() {
  for (Tear& tear : tears_) {
    exchange_.read_input(tear.links.front());
    const ValueSlice first = tear.links.front().target_value();
    for (OrderedExchange::Link& link : tear.links) {
      copy_elements(link.target_value(), first);
      exchange_.touch(link);
    }
  }
}

bool AlgebraicLoop::has_converged() {
  collect();
  return std::all_of(unknowns_.begin(), unknowns_.end(),
                     [&](const Unknown& unknown) { return has_converged(unknown); });
}

void AlgebraicLoop::collect() {
  for (Tear& tear : tears_) {
    copy_elements({&tear.result, 0, tear.result.size()}, tear.source, tear.variable->conversion);
  }
}

bool AlgebraicLoop::has_converged(const Unknown& unknown) const {
  const Tear& tear = tears_[unknown.tear];
  const ValueSlice input = tear.links.front().target_value();
  const std::size_t at = input.first + unknown.element;
  if (!tear.is_real) return is_same(*input.block, at, tear.result, unknown.element);
  const double nominal = system_.variable(tear.links.front().target().id).nominal;
  return core::has_converged(real(input, unknown.element), real(tear.result, unknown.element),
                             nominal, scale_.epsilon);
}

void AlgebraicLoop::sweep() {
  (*sweep_)();
  ++sweeps_;
  collect();
}

void AlgebraicLoop::solve(const Sweep& sweep, Time time) {
  sweep_ = &sweep;
  sweeps_ = 1;
  const Values first = inputs();
  if (iterate()) return;
  put(first);
  for (int round = 1;; ++round) {
    if (reals_.empty()) {
      this->sweep();
    } else if (!solve_reals()) {
      break;
    }
    if (have_held_values_converged()) return;
    if (round == kMostRounds) break;
    for (Tear& tear : tears_) {
      if (!tear.is_real) put(tear, tear.result);
    }
  }
  fail(time);
}

/// If the loop does not exist in fact, each sweep settles at least one more unknown: fewer than
/// before are unsettled, or some are that were not before.
bool AlgebraicLoop::iterate() {
  std::vector<char> met(unknowns_.size());
  std::size_t last_count = unknowns_.size() + 1;
  for (std::size_t sweeps = 0; sweeps <= unknowns_.size(); ++sweeps) {
    std::size_t count = 0;
    bool is_any_new = false;
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      if (has_converged(unknowns_[i])) continue;
      ++count;
      is_any_new |= std::exchange(met[i], true) == 0;
    }
    if (count == 0) return true;
    if (!is_any_new && count >= last_count) return false;
    last_count = count;
    for (Tear& tear : tears_) {
      if (is_finite(tear.result)) put(tear, tear.result);
    }
    sweep();
  }
  return false;
}

bool AlgebraicLoop::solve_reals() {
  std::vector<double> guess;
  for (const Unknown& unknown : reals_) {
    guess.push_back(real(tears_[unknown.tear].links.front().target_value(), unknown.element));
  }
  const auto function = [&](std::span<const double> x, std::span<double> g) {
    put(x);
    sweep();
    for (std::size_t i = 0; i < reals_.size(); ++i) {
      g[i] = real(tears_[reals_[i].tear].result, reals_[i].element);
    }
  };
  LoopJacobian jacobian;
  if (derivatives_) {
    jacobian = [&](std::span<const double> x, std::span<double> columns) {
      for (std::size_t i = 0; i < reals_.size(); ++i) {
        derivatives_->derive(reals_[i].tear, reals_[i].element,
                             columns.subspan(i * x.size(), x.size()));
      }
    };
  }
  return solve_loop(function, std::move(guess), scale_, jacobian).found;
}

bool AlgebraicLoop::have_held_values_converged() const {
  return std::all_of(unknowns_.begin(), unknowns_.end(), [&](const Unknown& unknown) {
    return tears_[unknown.tear].is_real || has_converged(unknown);
  });
}

AlgebraicLoop::Values AlgebraicLoop::inputs() const {
  Values values;
  for (const Tear& tear : tears_) {
    ValueBlock& value = values.emplace_back(tear.result.type(), tear.result.size());
    copy_elements({&value, 0, value.size()}, tear.links.front().target_value());
  }
  return values;
}

void AlgebraicLoop::put(const Values& values) {
  for (std::size_t i = 0; i < tears_.size(); ++i) put(tears_[i], values[i]);
}

void AlgebraicLoop::put(Tear& tear, const ValueBlock& value) {
  for (OrderedExchange::Link& link : tear.links) {
    const ValueSlice& to = link.target_value();
    if (copy_elements(*to.block, to.first, value, 0, value.size())) exchange_.touch(link);
  }
}

void AlgebraicLoop::put(std::span<const double> x) {
  for (std::size_t i = 0; i < reals_.size(); ++i) {
    for (OrderedExchange::Link& link : tears_[reals_[i].tear].links) {
      if (change_real(link.target_value(), reals_[i].element, x[i])) exchange_.touch(link);
    }
  }
}

// ---- Failure ----

void AlgebraicLoop::fail(Time time) const {
  fail_run({{}, {}, {}, time},
           fmt::format("no solution of the algebraic loop {} was found in {} evaluations: {}",
                       path_text(plan_), sweeps_, values_text()),
           hint());
}

std::string AlgebraicLoop::values_text() const {
  std::vector<std::string> texts;
  std::size_t count = 0;
  for (const Unknown& unknown : unknowns_) {
    if (has_converged(unknown) || ++count > kMostValues) continue;
    const Tear& tear = tears_[unknown.tear];
    const ValueSlice input = tear.links.front().target_value();
    const ElementRange to = tear.links.front().target();
    std::string text = fmt::format("with {} = {} the loop returns {}",
                                   system_.range_name({to.id, to.first + unknown.element, 1}),
                                   element_text(*input.block, input.first + unknown.element),
                                   element_text(tear.result, unknown.element));
    if (tear.is_real) {
      const double x = real(input, unknown.element);
      text += fmt::format(", a residual of {:.3g}", real(tear.result, unknown.element) - x);
    }
    texts.push_back(std::move(text));
  }
  if (count > kMostValues) texts.push_back(fmt::format("{} more", count - kMostValues));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string AlgebraicLoop::hint() const {
  std::string text = fmt::format(
      "a unit in it whose output does not depend on its input at the same instant, as "
      "a delay or a state, breaks the loop; a start value of {} nearer to the solution "
      "may help",
      system_.range_name(tears_.front().links.front().target()));
  const std::string undeclared = undeclared_text(system_, plan_);
  return undeclared.empty() ? text
                            : text + "; " + undeclared + ", so all inputs are taken for them";
}

}  // namespace stride::core
