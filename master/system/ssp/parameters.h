// Parameter bindings of SSP: sets (.ssv) and mappings (.ssm), inline or in files.
#ifndef STRIDE_MASTER_SYSTEM_SSP_PARAMETERS_H
#define STRIDE_MASTER_SYSTEM_SSP_PARAMETERS_H

#include <filesystem>
#include <string>
#include <vector>

#include "master/base/xml/element.h"
#include "master/system/ssp/definitions.h"
#include "master/system/ssp/files.h"
#include "master/system/ssp/system_tree.h"

namespace stride::ssp {

/// The position of the bindings of a component or system.
struct BindingContext {
  Files& files;
  std::vector<std::filesystem::path> folders;  ///< of the .ssd
  const Definitions& definitions;              ///< of the .ssd
  std::vector<std::string>& warnings;
  std::filesystem::path component{};  ///< the source of the component, if it is an FMU
  std::vector<std::filesystem::path> component_folders{};  ///< of its .ssd, if it is a system
};

/// The values of all bindings of a component or system, in the order of the file: a later one
/// replaces an earlier one. With a parameter mapping, those that it names, by their new names;
/// a name that it maps and no set has is warned of. Throws core::Error (Input).
std::vector<ParameterValue> read_parameters(const xml::Element& owner,
                                            const BindingContext& context);

/// The values of a file that is a parameter set (.ssv), in its order, with their places in it; what
/// is odd, but no mistake, is added to `warnings`. Throws core::Error (Input).
std::vector<ParameterValue> read_parameter_set(const std::filesystem::path& file,
                                               std::vector<std::string>& warnings);
/// Those of these values that a file which is a parameter mapping (.ssm) names, by their new names;
/// a name that it maps and no value has is warned of. Throws core::Error (Input).
std::vector<ParameterValue> map_parameters(const std::filesystem::path& mapping,
                                           const std::vector<ParameterValue>& values,
                                           std::vector<std::string>& warnings);

}  // namespace stride::ssp

#endif
