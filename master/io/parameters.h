// Parameter bindings of SSP: inline sets, and .ssv files.
#ifndef STRIDE_MASTER_IO_PARAMETERS_H
#define STRIDE_MASTER_IO_PARAMETERS_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/core/error.h"
#include "master/xml/element.h"

namespace stride::io {

struct ParameterValue {
  std::string name;   ///< with the binding's prefix before it
  std::string value;  ///< the elements of an array separated by blanks
  std::string unit;   ///< empty = the variable's own
  core::Location where;
};

/// The values of all bindings of a component or system, in the order of the file: a later one
/// replaces an earlier one. External sets are read relative to `folder`. Throws core::Error
/// (Input).
std::vector<ParameterValue> read_parameters(const xml::Element& owner,
                                            const std::filesystem::path& folder);

}  // namespace stride::io

#endif
