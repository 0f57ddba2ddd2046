// Reads a clock of a modelDescription.xml.
#ifndef STRIDE_MASTER_LOADER_FMU_DESCRIPTION_CLOCK_ATTRIBUTES_H
#define STRIDE_MASTER_LOADER_FMU_DESCRIPTION_CLOCK_ATTRIBUTES_H

#include <optional>
#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/engine/model/description.h"

namespace stride::importer {

/// The attributes of a <Clock>, which its declared <ClockType> may give as well (FMI 3.0, 2.4.7.4).
/// Throws core::Error of the kind Input that names the attribute and its line: no interval where
/// there must be one, one that is not positive, a time-based clock that is no input. Appends
/// warnings.
core::ClockAttributes read_clock_attributes(const xml::Element& clock,
                                            const std::optional<xml::Element>& declared_type,
                                            core::Causality causality,
                                            std::vector<std::string>& warnings);

}  // namespace stride::importer

#endif
