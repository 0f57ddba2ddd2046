#ifndef STRIDE_MASTER_SYSTEM_DECLARATION_FIND_VARIABLE_H
#define STRIDE_MASTER_SYSTEM_DECLARATION_FIND_VARIABLE_H

#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/suggest.h"
#include "master/engine/model/system/system.h"

namespace stride::scenario {

/// The component's variable with this name, if fits(description, variable). Throws core::Error
/// (Input) that says that it is not `kind`, with the nearest name of one that fits.
template <class Fits>
core::VariableId find_variable(const core::System& system, const std::string& name,
                               const core::Location& where, const char* kind, Fits&& fits) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    const core::UnitDescription& description = *system.components()[i].description;
    for (std::size_t k = 0; k < description.variables.size(); ++k) {
      if (!fits(description, description.variables[k])) continue;
      names.push_back(system.full_name({i, k}));
      if (names.back() == name) return {i, k};
    }
  }
  core::fail_input({where, {}, {}, {}}, fmt::format("'{}' is not {}", name, kind),
                   core::suggestion(name, names));
}

}  // namespace stride::scenario

#endif
