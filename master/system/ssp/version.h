// The versions of SSP.
#ifndef STRIDE_MASTER_SYSTEM_SSP_VERSION_H
#define STRIDE_MASTER_SYSTEM_SSP_VERSION_H

#include <string>
#include <vector>

#include "master/base/xml/element.h"

namespace stride::ssp {

/// The version of SSP by which a file with this root element is read, "1.0" or "2.0": another one
/// of the same major version is taken for it, with a warning. Throws core::Error (Input) for
/// others.
std::string read_version(const xml::Element& root, std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
