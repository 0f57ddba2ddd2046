// The connectors that a component declares.
#ifndef STRIDE_MASTER_IO_CONNECTORS_H
#define STRIDE_MASTER_IO_CONNECTORS_H

#include <string>
#include <vector>

#include "master/core/system.h"
#include "master/xml/element.h"

namespace stride::io {

/// Reads <ssd:Connectors> of a component. In a file of SSP 1.0, Real and Integer leave the width
/// open, so they set no type. Throws core::Error (Input).
std::vector<core::ConnectorDeclaration> read_connectors(const xml::Element& component,
                                                        const std::string& ssp_version);

}  // namespace stride::io

#endif
