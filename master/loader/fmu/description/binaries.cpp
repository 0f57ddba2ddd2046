#include "master/loader/fmu/description/binaries.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/files/input_file.h"
#include "master/base/text/lower_case.h"

#if !defined(__linux__)
#error "FMI platform names: add those of this operating system (FMI 3.0, 2.5.1.1; FMI 2.0, 2.3)"
#endif
#if defined(__x86_64__)
#define STRIDE_PLATFORM "x86_64-linux"
#define STRIDE_FMI2_PLATFORM "linux64"
#elif defined(__aarch64__)
#define STRIDE_PLATFORM "aarch64-linux"
#define STRIDE_FMI2_PLATFORM STRIDE_PLATFORM
#elif defined(__i386__)
#define STRIDE_PLATFORM "x86-linux"
#define STRIDE_FMI2_PLATFORM "linux32"
#else
#error "FMI platform names: add those of this architecture (FMI 3.0, 2.5.1.1; FMI 2.0, 2.3)"
#endif

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> folder_names(const fs::path& folder) {
  std::vector<std::string> names;
  for (const fs::path& entry : core::folder_entries(folder)) {
    if (core::is_folder(entry)) names.push_back(entry.filename().string());
  }
  return names;
}

/// What to do about an FMU that has sources and no library.
std::string how_to_compile(const std::string& library) {
  return fmt::format(
      "'stride build FILE.fmu -o BUILT.fmu' compiles its folder 'sources' to '{}', in a copy; or "
      "let "
      "the tool that made it export binaries for Linux",
      library);
}

/// Likewise about one whose libraries are all for other platforms.
std::string how_to_export(const std::vector<std::string>& others) {
  const auto all = [&](auto&& test) { return std::all_of(others.begin(), others.end(), test); };
  if (all([](std::string_view name) {
        return name.find("win") == 0 || name.ends_with("-windows");
      })) {
    return "a Windows library cannot be loaded on Linux; export the unit on Linux, or for it, if "
           "its tool can do that";
  }
  const bool is_64_bit = sizeof(void*) == 8;
  if (is_64_bit && all([](std::string_view n) { return n == "linux32" || n == "x86-linux"; })) {
    return "a 64-bit program cannot load a 32-bit library; export the unit for 64-bit Linux";
  }
  return "export the unit for this platform";
}

/// The folder of this name, also by another case, if there is none of the same; else the name.
std::string platform_folder(const fs::path& binaries, const std::string& name) {
  if (core::is_folder(binaries / name)) return name;
  for (const std::string& other : folder_names(binaries)) {
    if (core::lower_case(other) == name) return other;
  }
  return name;
}

std::vector<fs::path> libraries_in(const fs::path& folder) {
  std::vector<fs::path> libraries = core::folder_entries(folder);
  std::erase_if(libraries, [](const fs::path& path) { return path.extension() != ".so"; });
  return libraries;
}

std::vector<std::string> file_names(const std::vector<fs::path>& paths) {
  std::vector<std::string> names;
  for (const fs::path& path : paths) names.push_back(path.filename().string());
  return names;
}

/// That of these libraries which is the unit's: of its name, also by another case, or the only one.
std::optional<fs::path> find_misnamed(const std::vector<fs::path>& libraries,
                                      const std::string& model_identifier) {
  const std::string wanted = core::lower_case(model_identifier);
  const auto has_name = [&](const fs::path& path) {
    return core::lower_case(path.stem().string()) == wanted;
  };
  if (std::ranges::count_if(libraries, has_name) == 1) {
    return *std::ranges::find_if(libraries, has_name);
  }
  return libraries.size() == 1 ? std::optional(libraries.front()) : std::nullopt;
}

/// In the FMU's folder: at its top, or else in the only folder there that has one.
fs::path find_binaries(const fs::path& fmu_folder) {
  const fs::path usual = "binaries";
  if (core::is_folder(fmu_folder / usual)) return usual;
  std::vector<std::string> others = folder_names(fmu_folder);
  std::erase_if(
      others, [&](const std::string& name) { return !core::is_folder(fmu_folder / name / usual); });
  return others.size() == 1 ? fs::path(others.front()) / usual : usual;
}

[[noreturn]] void fail_without_library(const fs::path& fmu_folder, bool is_fmi2,
                                       const std::string& expected, const core::Context& context) {
  const char* const name = is_fmi2 ? fmi2_platform() : platform();
  const fs::path binaries = find_binaries(fmu_folder);
  auto others = folder_names(fmu_folder / binaries);
  const std::string own = platform_folder(fmu_folder / binaries, name);
  if (std::erase(others, own) > 0) {
    const auto files = file_names(core::folder_entries(fmu_folder / binaries / own));
    core::fail_input(
        context,
        fmt::format("the FMU's folder '{}' has no library; it {}", (binaries / own).string(),
                    files.empty() ? "is empty" : fmt::format("has {}", fmt::join(files, ", "))),
        fmt::format("expected '{}': export the unit again", expected));
  }
  if (!others.empty()) {
    core::fail_input(
        context,
        fmt::format("the FMU has no binaries for {}; it has {}", name, fmt::join(others, ", ")),
        how_to_export(others));
  }
  const bool has_sources = core::is_folder(fmu_folder / "sources");
  core::fail_input(context,
                   fmt::format("the FMU has no binaries for {}; it has {}", name,
                               has_sources ? "its source code only" : "none at all"),
                   has_sources ? how_to_compile(expected) : "export the unit for this platform");
}

}  // namespace

const char* platform() { return STRIDE_PLATFORM; }
const char* fmi2_platform() { return STRIDE_FMI2_PLATFORM; }
const char* platform_of(const std::string& fmi_version) {
  return fmi_version.starts_with("3.") ? platform() : fmi2_platform();
}

FoundLibrary find_library(const fs::path& fmu_folder, const std::string& fmi_version,
                          const std::string& model_identifier, const core::Context& user) {
  const bool is_before_fmi3 = !fmi_version.starts_with("3.");
  const std::vector<std::string> names =
      is_before_fmi3 ? std::vector<std::string>{fmi2_platform(), platform()}
                     : std::vector<std::string>{platform(), fmi2_platform()};
  const std::string expected = fmt::format("binaries/{}/{}.so", names.front(), model_identifier);
  if (core::is_file(fmu_folder / expected)) return {fmu_folder / expected, ""};
  core::Context context = user;
  if (context.unit.empty()) context.unit = model_identifier;
  const fs::path binaries = find_binaries(fmu_folder);
  for (const std::string& name : names) {
    const fs::path folder = binaries / platform_folder(fmu_folder / binaries, name);
    const std::vector<fs::path> libraries = libraries_in(fmu_folder / folder);
    if (libraries.empty()) continue;
    const auto other = find_misnamed(libraries, model_identifier);
    if (!other) {
      core::fail_input(context, fmt::format("the FMU's library '{}' is missing", expected),
                       fmt::format("its name must be the modelIdentifier of the model description; "
                                   "there are {}",
                                   core::quoted(file_names(libraries))));
    }
    return {*other,
            fmt::format("its library is '{}'; expected '{}', by the modelIdentifier of its model "
                        "description and the platform's name",
                        (folder / other->filename()).string(), expected)};
  }
  fail_without_library(fmu_folder, is_before_fmi3, expected, context);
}

}  // namespace stride::importer
