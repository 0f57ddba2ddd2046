#include "master/study/campaign/definition/distribution_elements.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>

namespace stride::campaign {
namespace {

double finite(const xml::Element& element, const char* attribute) {
  const auto number = element.required_number<double>(attribute);
  if (std::isfinite(number)) return number;
  element.fail(fmt::format("{}=\"{}\" of {} is not finite", attribute, number, element.tag()));
}

double at_least_zero(const xml::Element& element, const char* attribute) {
  const double number = finite(element, attribute);
  if (number >= 0) return number;
  element.fail(fmt::format("the {} {} of {} is below 0", attribute, number, element.tag()));
}

xml::Element only_child(const xml::Element& element, const char* name) {
  if (const auto child = element.child(name)) return *child;
  element.fail(fmt::format("{} holds no <{}>", element.tag(), name));
}

Limits read_limits(const xml::Element& range) {
  range.allow_attributes({"lowerLimit", "upperLimit"});
  range.allow_children({});
  const Limits limits{finite(range, "lowerLimit"), finite(range, "upperLimit")};
  if (limits.lower <= limits.upper) return limits;
  range.fail(fmt::format("the range from {} to {} is empty", limits.lower, limits.upper),
             "lowerLimit is the smaller number");
}

std::optional<Limits> read_optional_limits(const xml::Element& owner) {
  owner.allow_children({"Range"});
  const auto range = owner.child("Range");
  return range ? std::optional(read_limits(*range)) : std::nullopt;
}

[[noreturn]] void refuse_user_defined(const xml::Element& element) {
  element.fail_unsupported(
      fmt::format("the distribution '{}', which is defined by a user", element.given("type")),
      "list its values: in a DistributionSet, a ValueSetDistribution, or in a file with "
      "<stride:ValueSets>");
}

// ---- Deterministic ----

ValueTable read_value_set(const xml::Element& set, std::size_t parameter) {
  set.allow_attributes({});
  set.allow_children({"Element"});
  ValueTable table{{parameter}, {}};
  for (const xml::Element& element : set.children()) {
    element.allow_attributes({"value"});
    element.allow_children({});
    table.rows.push_back({{literal(element.given("value"), element.where())}, element.where()});
  }
  if (table.rows.empty()) set.fail(fmt::format("{} holds no <Element>", set.tag()));
  return table;
}

Decimal read_decimal(const xml::Element& element, const char* attribute) {
  try {
    return parse_decimal(xml::without_blanks(element.given(attribute)));
  } catch (const std::invalid_argument& mistake) {
    element.fail(fmt::format("{}: {}", attribute, mistake.what()));
  }
}

ValueRange read_value_range(const xml::Element& element, std::size_t parameter) {
  element.allow_attributes({"stepWidth"});
  element.allow_children({"Range"});
  const xml::Element range = only_child(element, "Range");
  read_limits(range);
  ValueRange values{parameter, read_decimal(range, "lowerLimit"),
                    read_decimal(element, "stepWidth"), 0};
  if (values.step.coefficient <= 0) {
    element.fail(fmt::format("stepWidth=\"{}\" is not above 0", element.given("stepWidth")));
  }
  const auto count = count_steps(values.first, values.step, read_decimal(range, "upperLimit"));
  if (!count) {
    element.fail("the limits and the stepWidth differ by more than 18 digits",
                 "list the values in a DistributionSet");
  }
  values.count = *count;
  return values;
}

Factor read_single(const xml::Element& element, ParameterList& parameters) {
  element.allow_attributes({"parameterName"});
  element.allow_children({"DistributionSet", "DistributionRange", "UserDefinedDistribution"});
  const auto children = element.children();
  if (children.size() != 1) {
    element.fail(
        fmt::format("{} holds {} distributions, expected one", element.tag(), children.size()));
  }
  const std::size_t parameter = parameters.add(element.required("parameterName"), element.where());
  const xml::Element& distribution = children.front();
  if (distribution.local_name() == "DistributionSet") {
    return read_value_set(distribution, parameter);
  }
  if (distribution.local_name() == "DistributionRange") {
    return read_value_range(distribution, parameter);
  }
  refuse_user_defined(distribution);
}

/// A set need not name all parameters that others name.
void read_assignments(const xml::Element& set, ValueTable& table,
                      std::map<std::string, std::size_t>& columns, ParameterList& parameters) {
  set.allow_attributes({});
  set.allow_children({"ParameterAssignment"});
  ValueTable::Row row{{}, set.where()};
  for (const xml::Element& assignment : set.children()) {
    assignment.allow_attributes({"parameterRef", "value"});
    assignment.allow_children({});
    const std::string name = assignment.required("parameterRef");
    const auto [column, is_new] = columns.emplace(name, columns.size());
    if (is_new) table.parameters.push_back(parameters.add(name, assignment.where()));
    row.values.resize(std::max(row.values.size(), column->second + 1));
    Text& value = row.values[column->second];
    if (value) assignment.fail(fmt::format("a second value for '{}' in this set", name));
    value = literal(assignment.given("value"), assignment.where());
  }
  if (row.values.empty()) set.fail(fmt::format("{} holds no <ParameterAssignment>", set.tag()));
  table.rows.push_back(std::move(row));
}

ValueTable read_multi(const xml::Element& element, ParameterList& parameters) {
  element.allow_attributes({});
  element.allow_children({"ValueSetDistribution"});
  const xml::Element distribution = only_child(element, "ValueSetDistribution");
  distribution.allow_attributes({});
  distribution.allow_children({"ParameterValueSet"});
  ValueTable table;
  std::map<std::string, std::size_t> columns;
  for (const xml::Element& set : distribution.children()) {
    read_assignments(set, table, columns, parameters);
  }
  if (table.rows.empty()) {
    distribution.fail(fmt::format("{} holds no <ParameterValueSet>", distribution.tag()));
  }
  for (ValueTable::Row& row : table.rows) row.values.resize(columns.size());
  return table;
}

// ---- Stochastic ----

/// What has a mean and a variance, and may have limits.
template <class Law>
Law read_law(const xml::Element& element) {
  element.allow_attributes({"expectedValue", "variance"});
  return {finite(element, "expectedValue"), at_least_zero(element, "variance"),
          read_optional_limits(element)};
}

void require_positive_mean(const xml::Element& element, double mean) {
  if (mean > 0) return;
  element.fail(fmt::format("the expectedValue {} of {} is not above 0", mean, element.tag()));
}

LogNormal read_log_normal(const xml::Element& element) {
  const auto law = read_law<LogNormal>(element);
  require_positive_mean(element, law.mean);
  return law;
}

Poisson read_poisson(const xml::Element& element) {
  element.allow_attributes({"expectedValue"});
  const Poisson law{finite(element, "expectedValue"), read_optional_limits(element)};
  require_positive_mean(element, law.mean);
  constexpr double kMostMean = 1e9;
  if (law.mean > kMostMean) {
    element.fail(
        fmt::format("the expectedValue {} of {} is above {}", law.mean, element.tag(), kMostMean),
        "write a NormalDistribution with this expectedValue and variance, which is nearly "
        "the same");
  }
  return law;
}

Uniform read_uniform(const xml::Element& element) {
  element.allow_attributes({});
  element.allow_children({"Range"});
  return {read_limits(only_child(element, "Range"))};
}

/// The weights are in proportion to probabilities.
template <class Weighted>
void require_weight(const xml::Element& element, const std::vector<Weighted>& items) {
  double sum = 0;
  for (const Weighted& item : items) sum += item.weight;
  if (items.empty()) element.fail(fmt::format("{} is empty", element.tag()));
  if (sum == 0) element.fail(fmt::format("the weights in {} sum to 0", element.tag()));
  if (!std::isfinite(sum))
    element.fail(fmt::format("the weights in {} are too large", element.tag()));
}

Histogram read_histogram(const xml::Element& element) {
  element.allow_attributes({});
  element.allow_children({"Bin"});
  Histogram histogram;
  for (const xml::Element& bin : element.children()) {
    bin.allow_attributes({"weight"});
    bin.allow_children({"Range"});
    histogram.bins.push_back({read_limits(only_child(bin, "Range")), at_least_zero(bin, "weight")});
  }
  require_weight(element, histogram.bins);
  std::ranges::stable_sort(histogram.bins, {}, [](const auto& bin) { return bin.limits.lower; });
  for (std::size_t i = 1; i < histogram.bins.size(); ++i) {
    const auto &one = histogram.bins[i - 1].limits, &other = histogram.bins[i].limits;
    if (one.upper <= other.lower) continue;
    element.fail(fmt::format("the bins from {} to {} and from {} to {} overlap", one.lower,
                             one.upper, other.lower, other.upper));
  }
  return histogram;
}

ProbabilitySet read_probability_set(const xml::Element& element) {
  element.allow_attributes({});
  element.allow_children({"Element"});
  ProbabilitySet set;
  for (const xml::Element& each : element.children()) {
    each.allow_attributes({"value", "weight"});
    each.allow_children({});
    set.elements.push_back(
        {literal(each.given("value"), each.where()), at_least_zero(each, "weight"), each.where()});
  }
  require_weight(element, set.elements);
  return set;
}

Distribution read_distribution(const xml::Element& element) {
  const std::string_view kind = element.local_name();
  if (kind == "ProbabilityDistributionSet") return read_probability_set(element);
  if (kind == "NormalDistribution") return read_law<Normal>(element);
  if (kind == "LogNormalDistribution") return read_log_normal(element);
  if (kind == "UniformDistribution") return read_uniform(element);
  if (kind == "PoissonDistribution") return read_poisson(element);
  if (kind == "Histogram") return read_histogram(element);
  refuse_user_defined(element);
}

StochasticParameter read_drawn(const xml::Element& element, ParameterList& parameters) {
  element.allow_attributes({"parameterName"});
  element.allow_children({"ProbabilityDistributionSet", "NormalDistribution",
                          "LogNormalDistribution", "UniformDistribution", "PoissonDistribution",
                          "Histogram", "UserDefinedDistribution"});
  const auto children = element.children();
  if (children.size() != 1) {
    element.fail(
        fmt::format("{} holds {} distributions, expected one", element.tag(), children.size()));
  }
  StochasticParameter drawn{parameters.add(element.required("parameterName"), element.where()),
                            read_distribution(children.front()), children.front().where()};
  if (has_probability(drawn.distribution)) return drawn;
  children.front().fail(
      fmt::format("{}: nothing is within these limits", to_text(drawn.distribution)),
      "choose limits that the distribution reaches");
}

}  // namespace

Deterministic read_deterministic(const xml::Element& element, ParameterList& parameters) {
  element.allow_attributes({});
  element.allow_children(
      {"DeterministicMultiParameterDistribution", "DeterministicSingleParameterDistribution"});
  Deterministic variation;
  for (const xml::Element& child : element.children()) {
    if (child.local_name() == "DeterministicSingleParameterDistribution") {
      variation.factors.push_back(read_single(child, parameters));
    } else {
      variation.factors.emplace_back(read_multi(child, parameters));
    }
  }
  return variation;
}

Stochastic read_stochastic(const xml::Element& element, ParameterList& parameters) {
  element.allow_attributes({"numberOfTestRuns", "randomSeed"});
  element.allow_children({"StochasticDistribution"});
  Stochastic variation;
  variation.runs = element.required_number<std::uint32_t>("numberOfTestRuns");
  if (variation.runs == 0) element.fail("numberOfTestRuns=\"0\": there is nothing to run");
  for (const xml::Element& child : element.children()) {
    variation.parameters.push_back(read_drawn(child, parameters));
  }
  return variation;
}

}  // namespace stride::campaign
