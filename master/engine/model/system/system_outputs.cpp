// The part of System that makes its outputs, and looks for names that are not their own.
#include <set>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "master/base/limited_warnings.h"
#include "master/engine/model/array_element.h"
#include "master/engine/model/finite.h"
#include "master/engine/model/meant_value.h"
#include "master/engine/model/system/declared_dimensions.h"
#include "master/engine/model/system/system.h"

namespace stride::core {
namespace {

/// What an output of the system has from its connector.
void take_connector(const PathConnector& connector, Variable& variable) {
  variable.type = *connector.type;
  variable.unit = connector.unit.name;
  variable.items = connector.items;
  variable.causality = Causality::Output;
  variable.clocks.clear();
}

}  // namespace

void System::add_outputs(const SystemDeclaration& declaration, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (std::size_t c = 0; !declaration.outputs.empty() && c < components_.size(); ++c) {
    const auto& variables = components_[c].description->variables;
    for (std::size_t v = 0; v < variables.size(); ++v) names.insert(full_name({c, v}));
  }
  for (const OutputDeclaration& wanted : declaration.outputs) {
    const bool is_new = names.insert(wanted.via.back().connector.name).second;
    if (!is_new) {
      note_shadowed(wanted);
    } else if (wanted.is_inner || wanted.component.empty()) {
      add_if_right(wanted, declaration);
    } else {
      diagnostics.attempt([&] { add_output(wanted, declaration); });
    }
  }
}

/// The run does not need it, so a mistake on the way to it is a warning.
void System::add_if_right(const OutputDeclaration& wanted, const SystemDeclaration& declaration) {
  try {
    add_output(wanted, declaration);
  } catch (const Error& mistake) {
    warnings_.push_back(fmt::format("{}\n  so '{}' cannot be recorded", mistake.what(),
                                    wanted.via.back().connector.name));
  }
}

/// A variable of the same name is recorded as it is.
void System::note_shadowed(const OutputDeclaration& wanted) {
  const std::string& name = wanted.via.back().connector.name;
  const std::string source = wanted.component.empty() ? wanted.via.front().connector.name
                                                      : wanted.component + "." + wanted.variable;
  if (name == source || wanted.is_inner) return;
  warnings_.push_back(to_text({.where = wanted.where}) +
                      fmt::format("the system's output '{}', which has the value of '{}', is not "
                                  "recorded, since a component's variable has its name\n"
                                  "  hint: rename the connector",
                                  name, source));
}

/// Scalars of an array become as many outputs.
void System::add_output(const OutputDeclaration& wanted, const SystemDeclaration& declaration) {
  if (wanted.component.empty()) return add_constant(wanted);
  const ConnectorElements from =
      find_elements({wanted.where, wanted.component, wanted.variable, {}}, &declaration);
  check_way(wanted.via, from);
  for (std::size_t i = 0; i < from.parts.size(); ++i) {
    const std::string& name = wanted.via.back().connector.name;
    add_output(wanted, from.parts[i],
               from.are_scalars() ? element_name(name, from.dimensions, i) : name);
  }
}

void System::add_output(const OutputDeclaration& wanted, const ElementRange& from,
                        const std::string& name) {
  const Variable& source = variable(from.id);
  if (!is_signal(from.id)) return;  // it is seen where it is sent
  Way way(path_connector(from));
  if (auto declared = declared_connector(from)) way.go(*std::move(declared), PathSegment{});
  for (const ViaDeclaration& via : wanted.via) way.go(via.connector, via.segment);
  const std::vector<PathConnector> path = completed(way.path);
  const PathConnector& end = path.back();
  const Conversion conversion = wanted.is_inner
                                    ? compose(path, way.segments, {wanted.where, {}, {}, {}})
                                    : converted_on(path, way.segments, wanted.where);
  SystemOutput output{from.id, conversion, source, from.first, wanted.is_inner};
  output.variable.name = name;
  if (!is_whole(from)) output.variable.dimensions.clear();
  output.variable.size = from.size;
  output.variable.aliases.clear();
  take_connector(end, output.variable);
  outputs_.push_back(std::move(output));
}

/// A value that is given to a connector of a system, and that no component has.
void System::add_constant(const OutputDeclaration& wanted) {
  const Context context{wanted.where, {}, {}, {}};
  Way way({"the value", {}, wanted.unit, {}, true});
  for (const ViaDeclaration& via : wanted.via) way.go(via.connector, via.segment);
  const PathConnector end = completed(way.path).back();
  if (!end.type) {
    fail_input(context, fmt::format("the connector '{}' has no type", end.name),
               "declare its type, such as <ssc:Float64/>");
  }
  SystemOutput output;
  output.is_inner = wanted.is_inner;
  Variable& variable = output.variable;
  variable.name = end.name;
  variable.variability = Variability::Fixed;
  take_connector(end, variable);
  variable.dimensions =
      known_sizes(wanted.via.back().dimensions).value_or(std::vector<Dimension>{});
  variable.size = element_count(variable.dimensions).value_or(1);
  note_unit(way, wanted.where);
  const auto [text, linear] =
      compose_text(wanted.value, way.path, way.segments, context, wanted.is_integer);
  try {
    output.constant =
        parse_converted(variable, meant_value(variable.type, text).value_or(text), linear);
  } catch (const std::invalid_argument& mistake) {
    fail_input(context, mistake.what());
  }
  outputs_.push_back(std::move(output));
}

/// A component "a.b" and its variable "c" have the name of "b.c" of a component "a".
void System::note_same_names(const SystemDeclaration& declaration) {
  LimitedWarnings twice(warnings_, "names that two variables have");
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const std::string& name = components_[i].name;
    for (std::size_t dot = name.find('.'); dot != name.npos; dot = name.find('.', dot + 1)) {
      const auto outer = names_.component(name.substr(0, dot));
      if (outer) note_same_names(declaration, *outer, i, twice);
    }
  }
  twice.finish();
}

/// The name of the inner component begins with that of the outer one.
void System::note_same_names(const SystemDeclaration& declaration, std::size_t outer,
                             std::size_t inner, LimitedWarnings& twice) const {
  const std::string& outer_name = components_[outer].name;
  const std::string& inner_name = components_[inner].name;
  const std::string rest = inner_name.substr(outer_name.size() + 1) + ".";
  for (const Variable& variable : components_[outer].description->variables) {
    if (!variable.name.starts_with(rest)) continue;
    const std::string same = variable.name.substr(rest.size());
    if (!names_.variable(inner, same) || !twice.count()) continue;
    twice.add(to_text({.where = declaration.components[inner].where}) +
              fmt::format("two variables are named '{0}.{1}': '{1}' of the component '{0}', and "
                          "'{2}' of the component '{3}' in line {4}; results and options do not "
                          "tell them apart\n  hint: rename one of the components",
                          inner_name, same, variable.name, outer_name,
                          declaration.components[outer].where.line));
  }
}

}  // namespace stride::core
