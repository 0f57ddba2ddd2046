#include "master/scenario/step_settings.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/util/number_text.h"
#include "master/util/suggest.h"
#include "master/util/time_text.h"

namespace stride::io {
namespace {

template <class Choices>
typename Choices::value_type parse_word(std::string_view text, const Choices& choices) {
  std::vector<std::string> words;
  for (const auto choice : choices) {
    words.emplace_back(name(choice));
    if (text == words.back()) return choice;
  }
  throw std::invalid_argument(
      fmt::format("'{}' is none of them; {}", text, core::suggestion(std::string(text), words)));
}

Duration parse_step(std::string_view text) {
  const Duration step = parse_seconds(text);
  if (step <= Duration::zero()) throw std::invalid_argument("a step must be above 0 s");
  return step;
}

template <class T>
void take(T& option, const std::optional<T>& choice) {
  if (choice) option = *choice;
}

}  // namespace

void StepSettings::set_policy(std::string_view text) {
  policy = parse_word(text, core::kStepPolicies);
}
void StepSettings::set_size(std::string_view text) { size = parse_step(text); }
void StepSettings::set_maximum(std::string_view text) { maximum = parse_step(text); }
void StepSettings::set_minimum(std::string_view text) { minimum = parse_step(text); }
void StepSettings::set_relative_tolerance(std::string_view text) {
  relative_tolerance = parse_at_least_zero(text);
}
void StepSettings::set_absolute_tolerance(std::string_view text) {
  absolute_tolerance = parse_at_least_zero(text);
}
void StepSettings::set_coupling(std::string_view text) {
  coupling = parse_word(text, core::kCouplings);
}
void StepSettings::set_extrapolation(std::string_view text) {
  extrapolation = parse_word(text, core::kExtrapolations);
}

void StepSettings::apply(core::RunOptions& options) const {
  take(options.step.policy, policy);
  take(options.step.size, size);
  if (maximum) options.step.maximum = maximum;
  take(options.step.minimum, minimum);
  take(options.step.relative_tolerance, relative_tolerance);
  take(options.step.absolute_tolerance, absolute_tolerance);
  take(options.coupling, coupling);
  take(options.extrapolation, extrapolation);
}

}  // namespace stride::io
