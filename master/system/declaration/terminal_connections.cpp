#include "master/system/declaration/terminal_connections.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "master/base/text/suggest.h"
#include "master/loader/fmu/description/terminals.h"

namespace stride::scenario {
namespace {

/// A terminal of a component.
struct End {
  const core::ComponentDeclaration* component;
  const importer::Terminal* terminal;
};

class Ends {
 public:
  Ends(std::span<const core::ComponentDeclaration> components,
       std::span<const std::shared_ptr<importer::Fmu>> fmus)
      : components_(components), fmus_(fmus) {}

  End find(const std::string& element, const std::string& name, const core::Location& where) {
    const std::size_t i = find_component(element, where);
    std::vector<std::string> names;
    for (const importer::Terminal& terminal : terminals_of(*fmus_[i])) {
      if (terminal.name == name) return {&components_[i], &terminal};
      names.push_back(terminal.name);
    }
    core::fail_input({.where = where, .unit = element},
                     fmt::format("the unit has no terminal '{}'", name),
                     names.empty() ? "its FMU has no terminalsAndIcons.xml with terminals"
                                   : core::suggestion(name, names));
  }

 private:
  /// Read once.
  const std::vector<importer::Terminal>& terminals_of(const importer::Fmu& fmu) {
    const auto [found, is_new] = terminals_.try_emplace(&fmu);
    if (is_new) found->second = importer::read_terminals(fmu.folder(), fmu.path().string());
    return found->second;
  }

  std::size_t find_component(const std::string& element, const core::Location& where) const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < components_.size(); ++i) {
      if (components_[i].name == element) return i;
      names.push_back(components_[i].name);
    }
    core::fail_input({.where = where}, fmt::format("there is no component '{}'", element),
                     core::suggestion(element, names));
  }

  std::span<const core::ComponentDeclaration> components_;
  std::span<const std::shared_ptr<importer::Fmu>> fmus_;
  std::map<const importer::Fmu*, std::vector<importer::Terminal>> terminals_;
};

/// Whether a connection begins at the variable; one that is not there is reported later.
bool is_source(const End& end, const std::string& variable) {
  const core::UnitDescription& unit = *end.component->description;
  const auto place = unit.find(variable);
  if (!place) return false;
  const core::Variable& found = unit.variables[*place];
  return found.causality != core::Causality::Input || found.is_time_based_clock();
}

std::vector<importer::TerminalPair> match(const End& start, const End& end,
                                          const core::Location& where) {
  try {
    return importer::match_terminals(*start.terminal, *end.terminal);
  } catch (const core::Error& mistake) {
    core::fail_input({.where = where},
                     fmt::format("cannot connect the terminals of '{}' and '{}': {}",
                                 start.component->name, end.component->name, mistake.message()),
                     mistake.hint());
  }
}

}  // namespace

std::vector<core::ConnectionDeclaration> connect_terminals(
    std::span<const TerminalConnection> connections,
    std::span<const core::ComponentDeclaration> components,
    std::span<const std::shared_ptr<importer::Fmu>> fmus) {
  Ends ends(components, fmus);
  std::vector<core::ConnectionDeclaration> made;
  for (const TerminalConnection& wanted : connections) {
    const End start = ends.find(wanted.start_element, wanted.start_terminal, wanted.where);
    const End end = ends.find(wanted.end_element, wanted.end_terminal, wanted.where);
    for (const auto& [first, second] : match(start, end, wanted.where)) {
      const bool goes_on = is_source(start, first);
      core::ConnectionDeclaration& connection = made.emplace_back();
      connection.from_component = (goes_on ? start : end).component->name;
      connection.from_connector = goes_on ? first : second;
      connection.to_component = (goes_on ? end : start).component->name;
      connection.to_connector = goes_on ? second : first;
      connection.where = wanted.where;
    }
  }
  return made;
}

}  // namespace stride::scenario
