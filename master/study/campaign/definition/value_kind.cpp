#include "master/study/campaign/definition/value_kind.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "master/base/time_text.h"

namespace stride::campaign {

std::string number_text(const ValueKind& kind, double number) {
  switch (kind.type) {
    case ValueKind::Type::Float32:
      return fmt::format("{}", static_cast<float>(number));
    case ValueKind::Type::Whole:
      return fmt::format("{:.0f}", std::nearbyint(number) + 0.0);  // which has no -0
    case ValueKind::Type::Instant:
      return number < 0 ? fmt::format("{}", number)
                        : core::to_text(core::parse_seconds(fmt::format("{}", number)));
    default:
      return fmt::format("{}", number);
  }
}

std::optional<double> number_of(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(number) : std::nullopt;
}

std::string drawn_text(const ValueKind& kind, const Distribution& distribution, double u) {
  if (const auto* const set = std::get_if<ProbabilitySet>(&distribution)) {
    return set->elements[chosen_element(*set, u)].value;
  }
  const auto* const uniform = std::get_if<Uniform>(&distribution);
  const bool is_of_whole = uniform != nullptr && kind.type == ValueKind::Type::Whole;
  return number_text(kind, is_of_whole ? whole_quantile(*uniform, u) : quantile(distribution, u));
}

std::string seed_text(const ValueKind& kind, std::uint64_t bits) {
  const std::uint64_t more = kind.most_seed - kind.least_seed;
  return std::to_string(kind.least_seed + (more == UINT64_MAX ? bits : bits % (more + 1)));
}

}  // namespace stride::campaign
