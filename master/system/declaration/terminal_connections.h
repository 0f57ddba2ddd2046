// Connections of terminals, made connections of variables.
#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_TERMINAL_CONNECTIONS_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_TERMINAL_CONNECTIONS_H

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/base/error.h"
#include "master/engine/model/system_declaration.h"
#include "master/loader/fmu/fmu.h"

namespace stride::scenario {

/// <stride:TerminalConnection>: SSP has none.
struct TerminalConnection {
  std::string start_element, start_terminal;  ///< "node1", "CanChannel"
  std::string end_element, end_terminal;
  core::Location where{};
};

/// The connections of variables that are meant, each from the output to the input. `fmus` are those
/// of the components, in their order, which have their descriptions. Throws core::Error (Input) for
/// a component or a terminal that is not there, with the nearest name, and for terminals that do
/// not match.
std::vector<core::ConnectionDeclaration> connect_terminals(
    std::span<const TerminalConnection> connections,
    std::span<const core::ComponentDeclaration> components,
    std::span<const std::shared_ptr<importer::Fmu>> fmus);

}  // namespace stride::scenario

#endif
