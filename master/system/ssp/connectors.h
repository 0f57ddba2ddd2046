// The connectors that a component or system declares.
#ifndef STRIDE_MASTER_SYSTEM_SSP_CONNECTORS_H
#define STRIDE_MASTER_SYSTEM_SSP_CONNECTORS_H

#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/engine/model/system/system.h"
#include "master/system/ssp/definitions.h"
#include "master/system/ssp/system_tree.h"

namespace stride::ssp {

/// A file of SSP, as far as the readers of its parts need it.
struct SspFile {
  std::string version;      ///< "1.0" or "2.0"
  Definitions definitions;  ///< of units and enumerations
};

/// Reads <ssd:Connectors> of a component or system. In a file of SSP 1.0, Real and Integer leave
/// the width open, so they set no type. Throws core::Error (Input).
std::vector<Connector> read_connectors(const xml::Element& owner, const SspFile& file,
                                       std::vector<std::string>& warnings);

/// Reads an <ssc:Dimension> of a connector, dictionary entry or parameter. Throws core::Error
/// (Input).
core::DimensionDeclaration read_dimension(const xml::Element& dimension);

/// Reads the type of a connector or dictionary entry from one of its children; false if the child
/// is something else. Throws core::Error (Input).
bool read_type(const xml::Element& child, const SspFile& file,
               core::ConnectorDeclaration& connector, std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
