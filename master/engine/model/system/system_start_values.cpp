// The part of System that checks and makes its start values.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <type_traits>

#include <fmt/format.h>

#include "master/base/limited_warnings.h"
#include "master/base/message_text.h"
#include "master/base/text/suggest.h"
#include "master/base/text/words.h"
#include "master/engine/model/finite.h"
#include "master/engine/model/meant_value.h"
#include "master/engine/model/system/declared_dimensions.h"
#include "master/engine/model/system/system.h"
#include "master/engine/model/system/unknown_variable.h"

namespace stride::core {
namespace {

/// Only what FMI calls initial = exact or approx can be set before the start; of FMI 1.0, which has
/// no such word, what has a start value.
void check_settable(const UnitDescription& unit, const Variable& variable, const Context& context) {
  const bool exact = variable.initial == Initial::Exact || variable.initial == Initial::Approx;
  if (exact && variable.variability != Variability::Constant && variable.type != ValueType::Clock) {
    return;
  }
  if (unit.fmi_version.starts_with("1.")) {
    const bool is_constant = variable.variability == Variability::Constant;
    fail_input(context,
               is_constant ? "a constant cannot be set"
                           : fmt::format("a {} {} without a start value cannot be set",
                                         name(variable.variability), name(variable.causality)),
               "parameters, inputs and, in FMI 1.0, what has a start value in the model "
               "description can");
  }
  fail_input(context,
             fmt::format("a {} {} with initial = {} cannot be set", name(variable.variability),
                         name(variable.causality), name(variable.initial)),
             "parameters, inputs and what the unit declares as initial = exact can");
}

/// What is expected in place of a number that is out of range.
std::string bound_text(const Variable& variable, double number, double least, double most) {
  if (number < least) return "at least " + variable.min;
  return number > most ? "at most " + variable.max : "a number";
}

/// Whether the element lies within min and max, which are texts in the description.
void check_range(const Variable& variable, const ValueBlock& value, const Context& context) {
  visit(value, [&](auto elements) {
    using T = typename decltype(elements)::value_type;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<std::remove_const_t<T>, bool>) {
      const auto bound = [&](const std::string& text, double otherwise) {
        return text.empty() ? otherwise : std::strtod(text.c_str(), nullptr);
      };
      constexpr double kInfinity = std::numeric_limits<double>::infinity();
      const double least = bound(variable.min, -kInfinity);
      const double most = bound(variable.max, kInfinity);
      for (const auto element : elements) {
        const double number = static_cast<double>(element);
        if (number >= least && number <= most) continue;
        if (std::isnan(number) && variable.min.empty() && variable.max.empty()) continue;
        fail_input(context, fmt::format("the value {} is out of range, expected {}", element,
                                        bound_text(variable, number, least, most)));
      }
    }
  });
}

/// Of scalars that stand for an array, `first` among them.
std::vector<std::string> scalar_texts(const StartDeclaration& wanted, const Variable& first) {
  if (first.type != ValueType::Enumeration) return words_of(wanted.value);
  try {
    return element_texts(first, wanted.value);
  } catch (const std::invalid_argument& mistake) {
    fail_input({wanted.where, wanted.component, wanted.variable, {}}, mistake.what());
  }
}

/// Of numbers or Booleans of any types; of the other one with the opposite sign or truth.
bool is_same_number(const ValueBlock& value, std::size_t element, const ValueBlock& other,
                    std::size_t other_element, bool is_negative) {
  return visit(value, [&]<class A>(std::span<const A> ones) {
    return visit(other, [&]<class B>(std::span<const B> others) {
      if constexpr (std::is_arithmetic_v<A> && std::is_arithmetic_v<B>) {
        if (std::is_same_v<A, bool> && is_negative) return ones[element] != others[other_element];
        const auto number = static_cast<double>(others[other_element]);
        return static_cast<double>(ones[element]) == (is_negative ? -number : number);
      } else {
        return false;
      }
    });
  });
}

/// Of the command line the option alone.
std::string place_text(const Location& where) {
  return where.line == 0 ? where.file : fmt::format("{}:{}", where.file, where.line);
}

Variable element_of(const Variable& array) {
  Variable element = array;
  element.dimensions.clear();
  element.size = 1;
  return element;
}

}  // namespace

ValueBlock StartValue::over(const ValueBlock& own) const {
  ValueBlock all = value;
  for (const std::size_t element : kept) copy_elements(all, element, own, element, 1);
  return all;
}

/// Nothing, and a warning, where a parameter set holds a value for no component, as SSP allows.
void System::note_missing(const StartDeclaration& wanted) {
  try {
    const std::size_t component = find_component(wanted.component, wanted.where);
    fail_unknown({wanted.where, wanted.component, wanted.variable, {}},
                 *components_[component].description, nullptr);
  } catch (const Error& mistake) {
    if (!wanted.is_optional) throw;
    warnings_.push_back(fmt::format("{}\n  the value is ignored, as SSP requires", mistake.what()));
  }
}

/// Whether it is for a structural parameter, whose size no other one gives.
bool System::is_structural(const StartDeclaration& wanted) const {
  const std::size_t component = find_component(wanted.component, wanted.where);
  const UnitDescription& description = *components_[component].description;
  try {
    const auto found = core::find_elements(names_, component, description,
                                           {wanted.where, wanted.component, wanted.variable, {}});
    return found && variable(found->parts.front().id).causality == Causality::StructuralParameter;
  } catch (const Error&) {
    return false;  // an index may be right when the sizes are known
  }
}

/// Nothing if it is not there.
std::optional<System::Target> System::find_target(const StartDeclaration& wanted) const {
  const std::size_t component = find_component(wanted.component, wanted.where);
  const UnitDescription& description = *components_[component].description;
  const Context context{wanted.where, wanted.component, wanted.variable, {}};
  check_unambiguous(context, description);
  auto found = core::find_elements(names_, component, description, context);
  if (!found) return std::nullopt;
  for (const ElementRange& part : found->parts) {
    check_settable(description, variable(part.id), context);
  }
  return Target{&wanted, std::move(*found)};
}

/// Of those that are there; of the others, what must not be ignored is an error.
std::vector<System::Target> System::find_targets(const SystemDeclaration& declaration,
                                                 Diagnostics& diagnostics) {
  std::vector<Target> targets;
  std::vector<const StartDeclaration*> missing;
  std::set<std::size_t> found_groups;
  for (const StartDeclaration& wanted : declaration.start_values) {
    if (is_structural(wanted)) {
      found_groups.insert(wanted.group);
      continue;
    }
    if (diagnostics.mentions(wanted.component, wanted.variable)) continue;
    diagnostics.attempt([&] {
      if (auto target = find_target(wanted)) {
        found_groups.insert(wanted.group);
        targets.push_back(std::move(*target));
      } else {
        missing.push_back(&wanted);
      }
    });
  }
  LimitedWarnings ignored(warnings_,
                          "values of variables that are not there, which are ignored, too");
  for (const StartDeclaration* wanted : missing) {
    if (wanted->group != 0 && found_groups.contains(wanted->group)) continue;
    if (wanted->is_optional && !ignored.count()) continue;
    diagnostics.attempt([&] { note_missing(*wanted); });
  }
  ignored.finish();
  return targets;
}

/// A value for a connector of a system goes through the component's connector, which may have
/// another unit of measure than the variable; one for the component is for the variable.
Way System::way_of(const StartDeclaration& wanted, const ElementRange& part) const {
  Way way({"the value", {}, known_unit(wanted.unit, part.id.component), {}, true});
  auto declared = wanted.via.empty() ? std::nullopt : declared_connector(part);
  if (!declared) {
    way.go(wanted, path_connector(part));
    return way;
  }
  way.go(wanted, *std::move(declared));
  way.go(path_connector(part), PathSegment{});
  return way;
}

UnitOfMeasure System::start_unit(const StartDeclaration& wanted, const ElementRange& part) const {
  return first_unit(way_of(wanted, part).path);
}

/// A connector of a system without a unit of measure has that of the connectors behind it, "if
/// unambiguous" (SSP 2.0, 4.5.1).
void System::note_unit(const Way& way, const Location& where) {
  const bool is_open =
      way.path.size() > 2 && way.path[0].unit.name.empty() && way.path[1].unit.name.empty();
  if (!is_open) return;
  std::size_t place = 2;
  for (; place < way.path.size(); ++place) {
    const PathSegment& before = way.segments[place - 1];
    const bool is_changed =
        before.suppress_unit_conversion || before.transformation.kind != Transformation::Kind::None;
    if (is_changed) return;
    if (!way.path[place].unit.name.empty()) break;
  }
  if (place == way.path.size()) return;
  const PathConnector& taker = way.path[place];
  const auto [known, is_new] = taken_units_.try_emplace(way.path[1].name, taker.unit, taker.name);
  const auto& [unit, name] = known->second;
  const auto conversion = convert(unit, taker.unit);
  if (is_new || (conversion && conversion->is_identity())) return;
  if (!ambiguous_units_.insert(known->first).second) return;
  warnings_.push_back(
      to_text({.where = where}) +
      fmt::format("the connector '{}' has no unit of measure, and those behind it differ: '{}' "
                  "takes the value in '{}', and '{}' in '{}'\n"
                  "  hint: declare the unit of measure of the connector, or of the value",
                  known->first, name, unit.name, taker.name, taker.unit.name));
}

/// Of a part of the target, from that part's text.
ValueBlock System::start_value(const StartDeclaration& wanted, const ElementRange& part,
                               const std::string& given) {
  std::optional<Variable> element;
  if (!is_whole(part)) element = element_of(variable(part.id));
  const Variable& target = element ? *element : variable(part.id);
  const Context context{wanted.where, wanted.component, wanted.variable, {}};
  const UnitOfMeasure unit = known_unit(wanted.unit, part.id.component);
  const PathConnector end = path_connector(part);
  if (wanted.via.empty() && !wanted.suppress_unit_conversion && !convert(unit, end.unit)) {
    const std::string undefined = undefined_text(unit);
    fail_input(context,
               fmt::format("the value is in '{}', the variable in '{}'{}", unit.name, end.unit.name,
                           undefined),
               undefined.empty() ? "give the value in the variable's unit"
                                 : suggestion(unit.name, convertible_names(end.unit)));
  }
  if (!is_real(target.type) && !unit.name.empty()) {
    warnings_.push_back(to_text(context) +
                        fmt::format("the unit of measure '{}' of the value is ignored: the "
                                    "variable is {}, which has none",
                                    unit.name, name_with_article(target.type)));
  } else if (end.unit.name.empty() && wanted.via.empty() && !undefined_text(unit).empty()) {
    warnings_.push_back(to_text(context) +
                        fmt::format("nothing defines '{}', the unit of measure of the value, and "
                                    "the variable has none: the number is used as it is",
                                    unit.name));
  }
  const Way way = way_of(wanted, part);
  note_unit(way, wanted.where);
  const auto [text, linear] =
      compose_text(given, way.path, way.segments, context, wanted.is_integer);
  const std::optional<std::string> meant = meant_value(target.type, text);
  if (meant) {
    warnings_.push_back(to_text(context) +
                        fmt::format("'{}' is taken for {}", name_text(text), *meant));
  }
  try {
    ValueBlock value = parse_converted(target, meant.value_or(text), linear);
    check_range(target, value, context);
    if (const auto odd = not_finite(value)) {
      warnings_.push_back(to_text(context) +
                          fmt::format("the start value is {}, which is not a finite number", *odd));
    } else if (const auto lost = lost_number(meant.value_or(text), value, linear)) {
      warnings_.push_back(to_text(context) + fmt::format("the start value {}", *lost));
    }
    return value;
  } catch (const std::invalid_argument& mistake) {
    fail_input(
        context, mistake.what(),
        number_with_unit_hint(text, start_unit(wanted, part), end.is_relative.value_or(false)));
  }
}

void System::resize(const StartDeclaration& declaration, VariableId structural_parameter,
                    std::size_t size) {
  auto& shared = components_[structural_parameter.component].description;
  UnitDescription description = *shared;
  if (const Variable* large = description.resize(variable(structural_parameter).reference, size)) {
    fail_input({declaration.where, declaration.component, declaration.variable, {}},
               fmt::format("with the value {}, '{}' would have more than {} elements", size,
                           large->name, kMaxElements),
               "give a smaller value");
  }
  shared = std::make_shared<const UnitDescription>(std::move(description));
}

/// Of a connector of a system only the number of elements has to be that of its ends.
void System::check_value_dimensions(const Target& target) const {
  const auto& [wanted, elements] = target;
  if (wanted->dimensions.empty()) return;
  const std::optional<std::vector<Dimension>> given = known_sizes(wanted->dimensions);
  const bool fits = wanted->via.empty() ? are_same(wanted->dimensions, elements.dimensions)
                                        : !given || element_count(*given) == elements.size();
  if (fits) return;
  fail_input({wanted->where, wanted->component, wanted->variable, {}},
             fmt::format("the value has the dimensions {}, the variable is {}",
                         dimensions_text(wanted->dimensions), shape_text(elements)),
             "correct the size of its <ssc:Dimension>, or leave it out");
}

/// Scalars that stand for an array have a word of the text each.
void System::give(const Target& target, GivenValues& values) {
  check_value_dimensions(target);
  const auto& [wanted, elements] = target;
  const std::vector<std::string> texts =
      elements.are_scalars() ? scalar_texts(*wanted, variable(elements.parts.front().id))
                             : std::vector{wanted->value};
  if (texts.size() != elements.parts.size()) {
    fail_input({wanted->where, wanted->component, wanted->variable, {}},
               fmt::format("'{}' is not a value for it, expected {} {} values separated by blanks",
                           name_text(wanted->value), elements.parts.size(),
                           core::name(variable(elements.parts.front().id).type)));
  }
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const ElementRange& part = elements.parts[i];
    const ValueBlock value = start_value(*wanted, part, texts[i]);
    give(*wanted, part, value, values);
  }
}

VariableId System::value_owner(VariableId id) const {
  const auto& first = variable(id).shares_value_of;
  if (!first) return id;
  return {id.component, *components_[id.component].description->find(*first)};
}

/// Of values for the same elements, or for two names of one value in the unit, that differ: those
/// of one rank are a mistake, and of two names on the command line the user may not know that they
/// share a value.
void System::check_giver(const StartDeclaration& wanted, const ElementRange& part,
                         const ValueBlock& value, const GivenElements& given) {
  if (is_same_value(part, value, given)) return;
  const bool is_alias = given.id != part.id;
  const auto has_given = [&](const auto& giver) { return is_alias || giver.first.overlaps(part); };
  const auto& givers = given.givers;
  const auto found = std::find_if(givers.rbegin(), givers.rend(), has_given);
  if (found == givers.rend() || found->second == &wanted) return;
  const auto& [range, other] = *found;
  const std::string places = fmt::format(
      "'{}' has the value {} here, and '{}' {} in {}", range_name(part), name_text(wanted.value),
      range_name(range), name_text(other->value), place_text(other->where));
  const char* const why = is_alias ? "; both are names of one variable (one value reference)" : "";
  const Context context{wanted.where, wanted.component, wanted.variable, {}};
  if (wanted.rank != 0 && wanted.rank == other->rank) {
    fail_input(
        context,
        fmt::format("two values of one parameter set contradict each other: {}{}", places, why),
        "keep one of the two");
  }
  if (!is_alias || wanted.is_optional || other->is_optional) return;
  warnings_.push_back(to_text({.where = wanted.where}) + places + why + "; the later one is used");
}

/// Whether the elements have this value already.
bool System::is_same_value(const ElementRange& part, const ValueBlock& value,
                           const GivenElements& given) const {
  const bool is_negative = variable(part.id).is_negated != variable(given.id).is_negated;
  const auto is_same_element = [&](std::size_t i) {
    const std::size_t at = part.first + i;
    if (!given.is_given[at]) return true;
    if (value.type() == given.value.type() && !is_negative)
      return is_same(value, i, given.value, at);
    return is_same_number(value, i, given.value, at, is_negative);
  };
  for (std::size_t i = 0; i < part.size; ++i) {
    if (!is_same_element(i)) return false;
  }
  return true;
}

/// Of variables that share their value, which are scalars, the last one has it.
void System::give(const StartDeclaration& wanted, const ElementRange& part, const ValueBlock& value,
                  GivenValues& values) {
  const Variable& whole = variable(part.id);
  const VariableId owner = value_owner(part.id);
  if (const auto found = values.find(owner); found != values.end()) {
    check_giver(wanted, part, value, found->second);
    if (found->second.id != part.id) values.erase(found);
  }
  GivenElements nothing{part.id, {whole.type, 0}, {}};
  GivenElements& given = values.try_emplace(owner, std::move(nothing)).first->second;
  if (given.is_given.empty()) {
    given.value = {whole.type, whole.size};
    given.is_given.resize(whole.size);
  }
  copy_elements(given.value, part.first, value, 0, part.size);
  std::fill_n(given.is_given.begin() + static_cast<std::ptrdiff_t>(part.first), part.size, true);
  given.givers.emplace_back(part, &wanted);
}

std::vector<StartValue> System::listed(GivenValues values) {
  std::vector<StartValue> list;
  for (auto& [owner, given] : values) {
    StartValue& start = list.emplace_back(StartValue{given.id, std::move(given.value)});
    for (std::size_t i = 0; i < given.is_given.size(); ++i) {
      if (!given.is_given[i]) start.kept.push_back(i);
    }
  }
  return list;
}

/// They come first, since the sizes of arrays, and so their elements, follow from them.
void System::add_structural_values(const SystemDeclaration& declaration, Diagnostics& diagnostics) {
  GivenValues values;
  for (const StartDeclaration& wanted : declaration.start_values) {
    if (!is_structural(wanted)) continue;
    diagnostics.attempt([&] {
      const Target target = find_target(wanted).value();
      give(target, values);
      for (const ElementRange& part : target.elements.parts) {
        const ValueBlock& value = values.at(part.id).value;
        if (value.type() != ValueType::UInt64 || value.size() != 1) continue;
        resize(wanted, part.id, value.numbers<std::uint64_t>()[0]);
      }
    });
  }
  structural_values_ = listed(std::move(values));
}

/// A value that was set by name, and nothing of which is what the unit gets.
void System::note_replaced(const Target& target) {
  if (target.declaration->is_optional) return;
  const auto source_of = [&](const ElementRange& part) -> const Connection* {
    const auto is_of_part = [&](const ElementRange& range) { return range.overlaps(part); };
    if (std::ranges::any_of(unconnected_elements(part.id), is_of_part)) return nullptr;
    const auto sources = connections_to(part.id);
    const auto found = std::ranges::find_if(sources, is_of_part, &Connection::target);
    return found == sources.end() ? nullptr : &*found;
  };
  const std::vector<ElementRange>& parts = target.elements.parts;
  if (!std::ranges::all_of(parts, source_of)) return;
  warnings_.push_back(fmt::format(
      "{}'{}' is connected to '{}', whose value replaces this one at the initialisation",
      core::to_text(Context{target.declaration->where}), elements_name(target.elements),
      range_name(source_of(parts.front())->source())));
}

void System::add_start_values(const SystemDeclaration& declaration, Diagnostics& diagnostics) {
  GivenValues values;
  for (const Target& target : find_targets(declaration, diagnostics)) {
    diagnostics.attempt([&] { give(target, values); });
    note_replaced(target);
  }
  start_values_ = listed(std::move(values));
}

}  // namespace stride::core
