// Writes down the connectors that a scenario leaves to its units.
#ifndef STRIDE_MASTER_SYSTEM_SSP_COMPLETE_H
#define STRIDE_MASTER_SYSTEM_SSP_COMPLETE_H

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "master/engine/model/description.h"
#include "master/engine/model/system_declaration.h"

namespace stride::ssp {

/// By the component's name.
using Descriptions = std::map<std::string, std::shared_ptr<const core::UnitDescription>>;

/// The text of the .ssd with all inputs and outputs of its components declared, at any depth, so
/// that tools which want connectors can read it. `descriptions` holds one for each component that
/// is an FMU, by its path: "arm.motor". Complaints call the file `shown_as`, or by its path.
///
/// Added are, for each variable without a connector: the connector with its type, dimensions and
/// clocks, and the definition of its enumeration. Each unit of measure that a connector names gets
/// a definition: that of the description, or else the one that is known by the name. Added are
/// further `connections`, as far as they connect components of the outermost system and are not
/// there: those that only stride knows how to make. Everything else stays as it is, byte for byte
/// where the file is in UTF-8, which the text always is; completing twice changes nothing. In a
/// file of SSP 1.0 the types are those of 1.0. The file is one that read_scenario() reads. Throws
/// core::Error (Input) for a clock in a file of SSP 1.0, which has none.
std::string complete(const std::filesystem::path& path, const Descriptions& descriptions,
                     const std::string& shown_as = "",
                     std::span<const core::ConnectionDeclaration> connections = {});

}  // namespace stride::ssp

#endif
