#include "master/loader/fmu/description/terminals.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/xml/document.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTerminalsFile = "terminalsAndIcons/terminalsAndIcons.xml";
constexpr const char* kTransceiver = "org.fmi-ls-bus.transceiver";
constexpr std::string_view kSent = "Tx_";
constexpr std::string_view kReceived = "Rx_";

void read(const xml::Element& element, const std::string& prefix, std::vector<Terminal>& found) {
  const std::string name = prefix + element.required("name");
  Terminal terminal{
      name, element.attribute_or("terminalKind"), element.required("matchingRule"), {}};
  for (const xml::Element& member : element.children("TerminalMemberVariable")) {
    const std::string variable = member.required("variableName");
    terminal.members.push_back({variable, member.attribute_or("memberName", variable)});
  }
  found.push_back(std::move(terminal));
  for (const xml::Element& nested : element.children("Terminal")) read(nested, name + ".", found);
}

const TerminalMember* find(const Terminal& terminal, std::string_view name) {
  const auto found = std::ranges::find(terminal.members, name, &TerminalMember::name);
  return found == terminal.members.end() ? nullptr : &*found;
}

[[noreturn]] void fail_missing(const Terminal& without, std::string_view name) {
  core::fail_input({}, fmt::format("the terminal '{}' has no member '{}', which the other needs",
                                   without.name, name));
}

std::vector<TerminalPair> match_names(const Terminal& first, const Terminal& second, bool all) {
  std::vector<TerminalPair> pairs;
  for (const TerminalMember& member : first.members) {
    const TerminalMember* const other = find(second, member.name);
    if (other != nullptr) pairs.push_back({member.variable, other->variable});
    if (other == nullptr && all) fail_missing(second, member.name);
  }
  for (const TerminalMember& member : second.members) {
    if (all && find(first, member.name) == nullptr) fail_missing(first, member.name);
  }
  return pairs;
}

std::vector<TerminalPair> match_order(const Terminal& first, const Terminal& second) {
  if (first.members.size() != second.members.size()) {
    core::fail_input({},
                     fmt::format("the terminal '{}' has {} members, and '{}' has {}", first.name,
                                 first.members.size(), second.name, second.members.size()));
  }
  std::vector<TerminalPair> pairs;
  for (std::size_t i = 0; i < first.members.size(); ++i) {
    pairs.push_back({first.members[i].variable, second.members[i].variable});
  }
  return pairs;
}

/// What this side sends, in its order.
void add_sent(const Terminal& from, const Terminal& to, bool is_first,
              std::vector<TerminalPair>& pairs) {
  for (const TerminalMember& member : from.members) {
    if (!member.name.starts_with(kSent)) continue;
    const std::string wanted = std::string(kReceived) + member.name.substr(kSent.size());
    const TerminalMember* const other = find(to, wanted);
    if (other == nullptr) fail_missing(to, wanted);
    pairs.push_back(is_first ? TerminalPair{member.variable, other->variable}
                             : TerminalPair{other->variable, member.variable});
  }
}

}  // namespace

std::vector<Terminal> read_terminals(const fs::path& fmu_folder, const std::string& shown_as) {
  std::vector<Terminal> found;
  const fs::path file = fmu_folder / kTerminalsFile;
  if (fmu_folder.empty() || !core::is_file(file)) return found;
  const xml::Document document(file, shown_as + "/" + kTerminalsFile);
  const auto terminals = document.root().child("Terminals");
  if (!terminals) return found;
  for (const xml::Element& terminal : terminals->children("Terminal")) read(terminal, "", found);
  return found;
}

std::vector<TerminalPair> match_terminals(const Terminal& first, const Terminal& second) {
  if (first.matching_rule != second.matching_rule) {
    core::fail_input(
        {}, fmt::format("the terminal '{}' has the matching rule '{}', and '{}' has '{}'",
                        first.name, first.matching_rule, second.name, second.matching_rule));
  }
  if (first.matching_rule == "plug") return match_names(first, second, true);
  if (first.matching_rule == "bus") return match_names(first, second, false);
  if (first.matching_rule == "sequence") return match_order(first, second);
  if (first.matching_rule != kTransceiver) {
    core::fail_input({},
                     fmt::format("the matching rule '{}' of the terminal '{}' is not known",
                                 first.matching_rule, first.name),
                     fmt::format("connect its variables one by one; known are plug, bus, sequence "
                                 "and {}",
                                 kTransceiver));
  }
  std::vector<TerminalPair> pairs;
  add_sent(first, second, true, pairs);
  add_sent(second, first, false, pairs);
  return pairs;
}

}  // namespace stride::importer
