#include "master/engine/model/system/unknown_variable.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include <fmt/format.h>

#include "master/base/text/suggest.h"

namespace stride::core {
namespace {

const ComponentDeclaration* find(const SystemDeclaration& system, const std::string& name) {
  const auto found = std::ranges::find(system.components, name, &ComponentDeclaration::name);
  return found == system.components.end() ? nullptr : &*found;
}

class Wanted {
 public:
  Wanted(const SystemDeclaration& system, const std::string& component, const std::string& variable)
      : system_(system) {
    take_declared(component, variable);
    for (const ConnectionDeclaration& connection : system.connections) {
      if (connection.to_component == component && connection.to_connector == variable) {
        add_end(connection.from_component, connection.from_connector, Causality::Input);
      }
      if (connection.from_component == component && connection.from_connector == variable) {
        add_end(connection.to_component, connection.to_connector, Causality::Output);
      }
    }
  }

  std::string text() const {
    std::string text = causality_ == Causality::Input ? "an input" : "an output";
    if (causality_ && *causality_ != Causality::Input && *causality_ != Causality::Output) {
      text = fmt::format("a {}", name(*causality_));
    }
    if (type_) text += fmt::format(" {}", name(*type_));
    if (!unit_.empty()) text += fmt::format(" in {}", unit_);
    if (ends_.empty()) return text;
    return text + fmt::format("{} {}", causality_ == Causality::Input ? ", fed by" : " for",
                              quoted(ends_));
  }

 private:
  void take_declared(const std::string& component, const std::string& variable) {
    const ComponentDeclaration* declared = find(system_, component);
    if (declared == nullptr) return;
    const auto connector =
        std::ranges::find(declared->connectors, variable, &ConnectorDeclaration::name);
    if (connector == declared->connectors.end()) return;
    causality_ = connector->causality;
    type_ = connector->type;
    unit_ = connector->unit.name;
  }

  void add_end(const std::string& component, const std::string& variable, Causality causality) {
    if (!causality_) causality_ = causality;
    ends_.push_back(component + "." + variable);
    const ComponentDeclaration* other = find(system_, component);
    const auto place = other == nullptr ? std::nullopt : other->description->find(variable);
    if (!place) return;
    if (!type_) type_ = other->description->variables[*place].type;
    if (unit_.empty()) unit_ = other->description->variables[*place].unit;
  }

  const SystemDeclaration& system_;
  std::optional<Causality> causality_;
  std::optional<ValueType> type_;
  std::string unit_;
  std::vector<std::string> ends_;
};

/// Of structured names those that begin and end alike, if there are any: for joint.hand.start those
/// of the other joints.
std::vector<std::string> alike(const std::string& unknown, const std::vector<std::string>& names) {
  const std::size_t first = unknown.find('.');
  if (first == std::string::npos) return names;
  const std::string_view begin = std::string_view(unknown).substr(0, first + 1);
  const std::string_view end = std::string_view(unknown).substr(unknown.rfind('.'));
  std::vector<std::string> found;
  std::ranges::copy_if(names, std::back_inserter(found), [&](const std::string& name) {
    return name.starts_with(begin) && name.ends_with(end);
  });
  return found.empty() ? names : found;
}

bool is_connector(const Variable& variable) {
  return variable.causality == Causality::Input || variable.causality == Causality::Output;
}

bool is_settable(const Variable& variable) {
  return variable.causality == Causality::Input || variable.causality == Causality::Parameter ||
         variable.causality == Causality::StructuralParameter;
}

/// If no name is near, those are shown that may be meant: connectors where one is expected, else
/// what can be set. The unknown name may be a full one whose component is misspelt.
std::string hint(const Context& context, const UnitDescription& description,
                 bool is_connector_expected) {
  const std::string& unknown = context.variable;
  std::vector<std::string> names, expected;
  for (const Variable& variable : description.variables) {
    names.push_back(variable.name);
    if (is_connector_expected ? is_connector(variable) : is_settable(variable)) {
      expected.push_back(variable.name);
    }
  }
  const bool is_near = !nearest(unknown, names).empty();
  if (is_near) return suggestion(unknown, names);
  std::vector<std::string> full_names;
  for (const std::string& name : names) full_names.push_back(context.unit + "." + name);
  const bool is_full = !nearest(unknown, full_names).empty();
  if (is_full) return suggestion(unknown, full_names);
  return suggestion(unknown, alike(unknown, expected.empty() ? names : expected));
}

}  // namespace

/// The component is in the context; a swapped one is another model than its name lets expect.
void fail_unknown_variable(const Context& context, const UnitDescription& description,
                           const SystemDeclaration* system, bool has_hint) {
  std::string message = fmt::format("its model '{}' has no such variable", description.model_name);
  if (system != nullptr) {
    message += "; expected " + Wanted(*system, context.unit, context.variable).text();
  }
  fail_input(context, message, has_hint ? hint(context, description, system != nullptr) : "");
}

void check_unambiguous(const Context& context, const UnitDescription& description) {
  if (!description.ambiguous_names.contains(context.variable)) return;
  fail_input(context,
             fmt::format("several variables of its model '{}' have this name, so it is not known "
                         "which one is meant",
                         description.model_name),
             "give each variable in its modelDescription.xml a name of its own");
}

}  // namespace stride::core
