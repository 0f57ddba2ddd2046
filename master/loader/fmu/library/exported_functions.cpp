#include "master/loader/fmu/library/exported_functions.h"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/loader/fmu/library/fmi2_library.h"
#include "master/loader/fmu/library/fmi3_library.h"
#include "master/loader/fmu/library/library_file.h"

namespace stride::importer {
namespace {

std::vector<std::string> needed_functions(const std::string& fmi_version) {
  const bool is_fmi3 = fmi_version.starts_with("3.");
  std::vector<std::string> names;
  for (const std::string_view name : is_fmi3 ? fmi3_needed_functions() : fmi2_needed_functions()) {
    names.push_back(fmt::format("fmi{}{}", is_fmi3 ? 3 : 2, name));
  }
  return names;
}

/// Those that end in one of the names.
std::vector<std::string> with_other_prefix(const std::set<std::string>& exported,
                                           const std::vector<std::string>& names) {
  std::vector<std::string> found;
  for (const std::string& symbol : exported) {
    const auto ends_in = [&](const std::string& name) { return symbol.ends_with(name); };
    if (std::ranges::any_of(names, ends_in)) found.push_back(symbol);
  }
  return found;
}

}  // namespace

std::string prefix_note(const std::string& prefix) {
  return fmt::format(
      "its functions have the prefix '{}' of a static library, and other importers do not find "
      "them; compile it without FMI2_FUNCTION_PREFIX or FMI3_FUNCTION_PREFIX",
      prefix);
}

std::string check_exported_functions(const std::filesystem::path& library,
                                     const core::UnitDescription& unit) {
  const std::set<std::string> exported = exported_names(library);
  const std::string prefix = unit.model_identifier + "_";
  std::vector<std::string> missing = needed_functions(unit.fmi_version);
  std::erase_if(missing, [&](const std::string& name) { return exported.contains(name); });
  if (missing.empty()) return "";
  const auto others = with_other_prefix(exported, missing);
  std::erase_if(missing, [&](const std::string& name) { return exported.contains(prefix + name); });
  if (missing.empty()) return prefix_note(prefix);
  core::fail_input(
      {.unit = unit.model_identifier},
      fmt::format("the sources compile, but the library does not export {}, which an FMI {} "
                  "Co-Simulation unit must{}",
                  fmt::join(missing, ", "), unit.fmi_version,
                  others.empty() ? "" : fmt::format("; it exports {}", fmt::join(others, ", "))),
      others.empty() ? "let the description of the sources name all of their files, and export the "
                       "functions with C linkage and default visibility"
                     : "give the definition by which the sources leave out the prefix: -D NAME");
}

}  // namespace stride::importer
