// The two sides of an option's value "NAME=VALUE", where names may hold a '='.
#ifndef STRIDE_MASTER_SYSTEM_PLAN_SPLIT_OPTION_H
#define STRIDE_MASTER_SYSTEM_PLAN_SPLIT_OPTION_H

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "master/engine/model/system/known_names.h"

namespace stride::scenario {

/// The two sides of an option's value "NAME=VALUE", see core::KnownNames::split(). Throws
/// core::Error (Input) with the expected `form`.
std::pair<std::string, std::string> split_option(const std::string& option, const std::string& text,
                                                 const std::string& form,
                                                 const core::KnownNames& names);

/// The sides of "COMPONENT=FILE".
struct ComponentFile {
  std::string component;
  std::filesystem::path file;
};

/// Nothing if a side is missing. Throws core::Error (Input) for what can be meant in two ways.
std::optional<ComponentFile> split_component_file(const std::string& option,
                                                  const std::string& text,
                                                  const core::KnownNames& names);
/// Likewise, where the file is there.
std::optional<ComponentFile> split_existing_file(const std::string& option,
                                                 const std::string& text);
/// Likewise of an option; throws core::Error (Input) with the expected `form`.
ComponentFile component_file(const std::string& option, const std::string& text,
                             const std::string& form, const core::KnownNames& names);

}  // namespace stride::scenario

#endif
