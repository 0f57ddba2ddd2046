// The terminals of an FMU: groups of variables that are meant to be connected as one.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_TERMINALS_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_TERMINALS_H

#include <filesystem>
#include <string>
#include <vector>

namespace stride::importer {

struct TerminalMember {
  std::string variable;  ///< of the model description
  std::string name;      ///< within the terminal, by which members of both sides match
};

struct Terminal {
  std::string name;                     ///< "CanChannel"; of a nested one "Vehicle.CanChannel"
  std::string kind;                     ///< terminalKind; empty: not given
  std::string matching_rule;            ///< "plug", "bus", "sequence", "org.fmi-ls-bus.transceiver"
  std::vector<TerminalMember> members;  ///< without those of nested terminals
};

/// Those of the terminalsAndIcons.xml in an unpacked FMU of FMI 3.0, or of FMI 2.0 where a tool
/// writes one, nested ones behind those around them; none without that file. `shown_as`: the FMU.
/// Throws core::Error (Input) for what is malformed.
std::vector<Terminal> read_terminals(const std::filesystem::path& fmu_folder,
                                     const std::string& shown_as);

/// Two variables that are connected where two terminals are.
struct TerminalPair {
  std::string first, second;  ///< variables of the one and of the other
  bool operator==(const TerminalPair&) const = default;
};

/// By the rules of both, which are the same. `bus`: members of the same name, of those that both
/// have. `plug`: the same, and both have the same ones. `sequence`: by their order.
/// `org.fmi-ls-bus.transceiver` (FMI-LS-BUS 1.0): Tx_NAME of each to Rx_NAME of the other. Throws
/// core::Error (Input), without a place, where they do not match, with what is missing or other.
std::vector<TerminalPair> match_terminals(const Terminal& first, const Terminal& second);

}  // namespace stride::importer

#endif
