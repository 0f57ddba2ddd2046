#include "master/loader/fmu/description/model_description.h"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "master/base/limited_warnings.h"
#include "master/base/xml/document.h"
#include "master/loader/fmu/description/common_description.h"
#include "master/loader/fmu/description/fmi1_description.h"
#include "master/loader/fmu/description/fmi2_description.h"
#include "master/loader/fmu/description/fmi3_description.h"

namespace stride::importer {
namespace {

[[noreturn]] void fail_version(const xml::Element& root, const std::string& version) {
  root.fail(fmt::format("fmiVersion=\"{}\" is not supported; expected 1.0, 2.0 or 3.0", version),
            "export the unit as FMI 3.0 or FMI 2.0 Co-Simulation");
}

/// Units of drafts have functions with other arguments than those of the standard.
void check_version(const xml::Element& root, const std::string& version) {
  const std::string major = version.substr(0, 2);
  if (major != "1." && major != "2." && major != "3.") fail_version(root, version);
  if (!version.starts_with("3.0-alpha") && !version.starts_with("3.0-beta")) return;
  root.fail(fmt::format("fmiVersion=\"{}\" is a draft of FMI 3.0, whose functions have other "
                        "arguments",
                        version),
            "export the unit as FMI 3.0 or FMI 2.0 Co-Simulation");
}

/// "2" is taken for "2.0", with a warning.
std::string read_version(const xml::Element& root, std::vector<std::string>& warnings) {
  std::string version = root.required("fmiVersion");
  if (version.size() != 1 || version < "1" || version > "3") return version;
  warnings.push_back(core::to_text({.where = root.where()}) +
                     fmt::format("fmiVersion=\"{0}\" is taken for {0}.0", version));
  return version + ".0";
}

ModelDescription read(const xml::Document& document) {
  const xml::Element root = document.root();
  if (root.name().local != "fmiModelDescription") {
    root.fail(fmt::format("the document is a {}; expected <fmiModelDescription>", root.tag()));
  }
  if (!root.name().name_space.empty()) {
    root.fail(fmt::format("{} is in the namespace '{}'; that of FMI is in none", root.tag(),
                          root.name().name_space),
              "leave out the xmlns=\"…\" of this element");
  }
  ModelDescription unit;
  unit.warnings = document.warnings();
  unit.fmi_version = read_version(root, unit.warnings);
  check_version(root, unit.fmi_version);
  const std::string major = unit.fmi_version.substr(0, 2);
  unit.model_name = root.given("modelName");
  unit.description = root.attribute_or("description");
  unit.generation_tool = root.attribute_or("generationTool");
  read_units(root, unit);
  if (major == "1.") unit.fmi1 = read_fmi1_description(root, unit);
  if (major == "2.") unit.fmi2 = read_fmi2_description(root, unit);
  if (major == "3.") read_fmi3_description(root, unit);
  read_default_experiment(root, unit);
  core::limit_warnings(unit.warnings, fmt::format("warnings for {}", root.where().file));
  return unit;
}

}  // namespace

ModelDescription parse_model_description(const std::string& text, const std::string& shown_as) {
  return read(xml::Document::parse(text, shown_as));
}

ModelDescription read_model_description(const std::filesystem::path& file,
                                        const std::string& shown_as) {
  return read(xml::Document(file, shown_as));
}

}  // namespace stride::importer
