#include "master/study/search/way.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "master/study/campaign/intervention_parts.h"

namespace stride::search {
namespace {

using campaign::Text;
using Role = campaign::PlanColumn::Role;

std::optional<double> nominal_number(const campaign::Plan& plan,
                                     const campaign::CampaignScenario& scenario,
                                     std::size_t column) {
  const campaign::PlanColumn& of = plan.columns()[column];
  if (of.role == Role::Start) return scenario.scenario_value(column);
  if (of.role == Role::Swap) return std::nullopt;
  const auto text = campaign::part_text(plan.campaign().interventions[of.item].declared, of.part);
  return text ? campaign::number_of(*text) : std::nullopt;
}

double rounded(double number, int digits) {
  if (digits >= 0) return campaign::number_of(fmt::format("{:.{}f}", number, digits)).value();
  const double step = std::pow(10, -digits);
  return std::nearbyint(number / step) * step;
}

}  // namespace

Way::Way(const campaign::ValueKind& kind, std::optional<double> nominal, Text failing,
         double tolerance)
    : kind_(kind), nominal_(nominal), failing_(std::move(failing)) {
  if (failing_ && kind_.type != campaign::ValueKind::Type::Text) {
    number_ = campaign::number_of(*failing_);
  }
  if (!is_continuous()) return;
  constexpr double kShare = 0.5;  // of the tolerance, which rounding may take
  const double step = kShare * tolerance * std::abs(*number_ - *nominal_);
  digits_ = -static_cast<int>(std::floor(std::log10(step)));
}

Text Way::at(double share) const {
  if (share == 0) return std::nullopt;
  if (share == 1 || !is_continuous()) return failing_;
  const double number = *nominal_ + share * (*number_ - *nominal_);
  return number_text(kind_, rounded(number, digits_));
}

std::vector<Way> ways_of(const campaign::Plan& plan, const campaign::CampaignScenario& scenario,
                         const std::vector<Text>& failing, double tolerance) {
  std::vector<Way> ways;
  for (std::size_t i = 0; i < plan.campaign().parameters.size(); ++i) {
    ways.emplace_back(plan.kinds()[i], nominal_number(plan, scenario, i), failing[i], tolerance);
  }
  return ways;
}

}  // namespace stride::search
