// What SSP lets be done to a value between two connectors, or on its way to a parameter.
#ifndef STRIDE_MASTER_SYSTEM_SSP_TRANSFORMATION_H
#define STRIDE_MASTER_SYSTEM_SSP_TRANSFORMATION_H

#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/engine/model/conversion.h"

namespace stride::ssp {

/// Reads the attribute suppressUnitConversion and the transformation of an <ssd:Connection> or an
/// <ssm:MappingEntry>, whose other attributes and children are the caller's. Throws core::Error
/// (Input); adds warnings of what is written in another way.
core::PathSegment read_path_segment(const xml::Element& owner, std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
