#include "master/system/declaration/check_declaration.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/system/declaration/parse_attribute.h"
#include "master/system/ssp/ssp.h"

namespace stride::scenario {
namespace {

checks::Window read_window(const xml::Element& element) {
  checks::Window window;
  window.from = parse_optional_attribute(element, "from", core::parse_time);
  window.to = parse_optional_attribute(element, "to", core::parse_time);
  if (window.from && window.to && *window.from > *window.to) {
    element.fail(fmt::format("the interval ends at {} s, before it begins at {} s",
                             core::to_text(*window.to), core::to_text(*window.from)));
  }
  return window;
}

checks::ConditionText read_condition(const xml::Element& element) {
  checks::ConditionText condition;
  condition.min = element.attribute("min");
  condition.max = element.attribute("max");
  condition.above = element.attribute("above");
  condition.below = element.attribute("below");
  condition.equals = element.attribute("equals");
  condition.tolerance = element.attribute("tolerance");
  return condition;
}

void read_signal(const xml::Element& element, CheckDeclaration& check) {
  check.subject = element.required("signal");
  check.condition = read_condition(element);
}

void read_lasting(const xml::Element& element, CheckDeclaration& check) {
  element.allow_attributes(
      {"name", "signal", "min", "max", "above", "below", "equals", "tolerance", "from", "to"});
  read_signal(element, check);
  check.window = read_window(element);
}

constexpr const char* kCondition = "Condition";

void read_until(const xml::Element& element, CheckDeclaration& check) {
  read_lasting(element, check);
  const auto ending = element.child({ssp::kStrideScenario, kCondition});
  if (!ending) element.fail("it has no <stride:Condition signal=\"…\" …/>, which ends it");
  ending->allow_children({});
  ending->allow_attributes({"signal", "min", "max", "above", "below", "equals", "tolerance"});
  check.ending_signal = ending->required("signal");
  check.ending = read_condition(*ending);
}

void read_final(const xml::Element& element, CheckDeclaration& check) {
  element.allow_attributes(
      {"name", "signal", "min", "max", "above", "below", "equals", "tolerance"});
  read_signal(element, check);
}

void read_count(const xml::Element& element, CheckDeclaration& check) {
  element.allow_attributes({"name", "event", "min", "max", "equals", "from", "to"});
  check.subject = element.required("event");
  check.window = read_window(element);
  check.min = element.number<std::uint64_t>("min");
  check.max = element.number<std::uint64_t>("max");
  const auto equals = element.number<std::uint64_t>("equals");
  if (equals && (check.min || check.max)) {
    element.fail("equals and limits exclude each other");
  }
  if (equals) check.min = check.max = equals;
  if (!check.min && !check.max) element.fail("it has no limit; expected min, max or equals");
  if (check.min && check.max && *check.min > *check.max) {
    element.fail(fmt::format("no count is {} at least and {} at most", *check.min, *check.max));
  }
}

void read_answer(const xml::Element& element, CheckDeclaration& check) {
  element.allow_attributes({"name", "request", "reply", "within", "repeats", "from", "to"});
  check.subject = element.required("request");
  check.reply = element.required("reply");
  check.within = parse_attribute(element, "within", core::parse_seconds);
  check.repeats = element.flag("repeats");
  check.window = read_window(element);
}

struct Word {
  const char* element;
  checks::Kind kind;
  void (*read)(const xml::Element& element, CheckDeclaration& check);
  const char* child = nullptr;  ///< the only one that it has
};
constexpr std::array kWords{Word{"Always", checks::Kind::Always, read_lasting},
                            Word{"Never", checks::Kind::Never, read_lasting},
                            Word{"Eventually", checks::Kind::Eventually, read_lasting},
                            Word{"Until", checks::Kind::Until, read_until, kCondition},
                            Word{"Final", checks::Kind::Final, read_final},
                            Word{"Count", checks::Kind::Count, read_count},
                            Word{"Answer", checks::Kind::Answer, read_answer}};

}  // namespace

std::vector<CheckDeclaration> read_checks(const xml::Element& checks) {
  checks.allow_attributes({});
  std::vector<xml::Name> known;
  for (const Word& word : kWords) known.emplace_back(ssp::kStrideScenario, word.element);
  known.emplace_back(ssp::kStrideScenario, "Covered");
  checks.allow_children(known);
  std::vector<CheckDeclaration> found;
  for (const xml::Element& element : checks.children()) {
    for (const Word& word : kWords) {
      if (!element.is(ssp::kStrideScenario, word.element)) continue;
      if (word.child != nullptr) {
        element.allow_children({{ssp::kStrideScenario, word.child}});
      } else {
        element.allow_children({});
      }
      CheckDeclaration& check = found.emplace_back();
      check.kind = word.kind;
      if (element.attribute("name")) check.name = element.required_line("name");
      check.where = element.where();
      word.read(element, check);
    }
  }
  return found;
}

}  // namespace stride::scenario
