// The units and enumerations that a file of SSP defines for itself.
#ifndef STRIDE_MASTER_SYSTEM_SSP_DEFINITIONS_H
#define STRIDE_MASTER_SYSTEM_SSP_DEFINITIONS_H

#include <map>
#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/engine/model/conversion.h"

namespace stride::ssp {

struct Definitions {
  core::UnitsOfMeasure units_of_measure;
  std::map<std::string, core::EnumerationItems> enumerations;

  /// The unit of this name, with its meaning if it is defined.
  core::UnitOfMeasure unit(const std::string& name) const;
  /// Likewise, where `otherwise` may define it, too.
  core::UnitOfMeasure unit(const std::string& name, const Definitions& otherwise) const;
};

/// Reads <Units> and <Enumerations> below a root element of this namespace. Elements within
/// <Units> that are in another namespace than they should be are taken with a warning, and others
/// ignored with one. Throws core::Error (Input).
Definitions read_definitions(const xml::Element& root, const char* name_space,
                             std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
