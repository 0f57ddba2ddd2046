#include "master/loader/fmu/description/build_description.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/text/words.h"
#include "master/base/xml/document.h"
#include "master/loader/fmu/description/binaries.h"

namespace stride::importer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBuildFile = "sources/buildDescription.xml";

/// A name within the folder.
fs::path inner_path(const xml::Element& element) {
  const fs::path path = fs::path(element.required("name")).lexically_normal();
  if (path.is_relative() && *path.begin() != "..") return path;
  element.fail(fmt::format("name=\"{}\" of {} is not within the folder 'sources'", path.string(),
                           element.tag()));
}

std::string definition(const xml::Element& element) {
  const auto value = element.attribute("value");
  return element.required("name") + (value && !value->empty() ? "=" + *value : "");
}

SourceFileSet read_set(const xml::Element& element, std::vector<std::string>& warnings) {
  SourceFileSet set;
  set.language = element.attribute_or("language");
  const std::string compiler = element.attribute_or("compiler");
  const bool is_ours = compiler.empty() || compiler == "gcc" || compiler == "clang";
  if (is_ours) set.options = core::words_of(element.attribute_or("compilerOptions"));
  for (const xml::Element& file : element.children("SourceFile")) {
    set.files.push_back(inner_path(file));
  }
  for (const xml::Element& one : element.children("PreprocessorDefinition")) {
    if (!one.lenient_flag("optional", warnings)) set.definitions.push_back(definition(one));
  }
  for (const xml::Element& folder : element.children("IncludeDirectory")) {
    set.includes.push_back(inner_path(folder));
  }
  return set;
}

/// That of the model which is for this platform, or else for any.
xml::Element find_configuration(const xml::Element& root, const std::string& model_identifier) {
  std::optional<xml::Element> found;
  for (const xml::Element& configuration : root.children("BuildConfiguration")) {
    if (configuration.required("modelIdentifier") != model_identifier) continue;
    const std::string wanted = configuration.attribute_or("platform");
    if (wanted == platform()) return configuration;
    if (wanted.empty() && !found) found = configuration;
  }
  if (found) return *found;
  root.fail(fmt::format("there is no <BuildConfiguration> of the modelIdentifier '{}' for {}",
                        model_identifier, platform()),
            "the FMU cannot be built for this platform by its own description");
}

BuildDescription read_fmi3(const fs::path& file, const std::string& model_identifier) {
  const xml::Document document(file, kBuildFile);
  const xml::Element configuration = find_configuration(document.root(), model_identifier);
  BuildDescription build;
  for (const xml::Element& set : configuration.children("SourceFileSet")) {
    build.sets.push_back(read_set(set, build.warnings));
  }
  for (const xml::Element& library : configuration.children("Library")) {
    build.libraries.push_back(library.required("name"));
  }
  return build;
}

BuildDescription read_fmi2(const fs::path& model_description) {
  const xml::Document document(model_description, model_description.filename().string());
  BuildDescription build;
  std::vector<std::string> said_before;
  const auto unit = document.root().lenient_child("CoSimulation", said_before);
  const auto list = unit ? unit->child("SourceFiles") : std::nullopt;
  if (!list) return build;
  SourceFileSet& set = build.sets.emplace_back();
  for (const xml::Element& file : list->children("File")) set.files.push_back(inner_path(file));
  return build;
}

}  // namespace

BuildDescription read_build_description(const fs::path& model_description,
                                        const core::UnitDescription& unit) {
  const fs::path build_file = model_description.parent_path() / kBuildFile;
  const bool is_fmi3 = unit.fmi_version.starts_with("3.");
  if (is_fmi3 && !core::is_file(build_file)) {
    core::fail_input(
        {.unit = unit.model_identifier},
        fmt::format("the FMU has no '{}', so it is not known how to compile it", kBuildFile),
        "export it with its sources, or with binaries for this platform");
  }
  BuildDescription build =
      is_fmi3 ? read_fmi3(build_file, unit.model_identifier) : read_fmi2(model_description);
  const bool has_files =
      std::ranges::any_of(build.sets, [](const SourceFileSet& set) { return !set.files.empty(); });
  if (has_files) return build;
  core::fail_input({.unit = unit.model_identifier}, "the FMU lists no source files",
                   "export it with its sources, or with binaries for this platform");
}

}  // namespace stride::importer
