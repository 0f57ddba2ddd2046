#include "master/loader/fmu/description/idle_manifest.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include <stride/idle.h>

#include "master/base/xml/document.h"

namespace stride::importer {
namespace {

constexpr const char* kNamespace = "http://fmi-standard.org/fmi-ls-manifest";

/// Whether elements that are not known here may be those of a later version.
bool check_head(const xml::Element& root) {
  constexpr const char* kRoot = "fmiLayeredStandardManifest";
  if (!root.is("", kRoot) && !root.is(kNamespace, kRoot)) {
    root.fail(
        fmt::format("the document is a {}; expected <fmiLayeredStandardManifest>", root.tag()));
  }
  const auto name = root.attribute(kNamespace, "fmi-ls-name");
  if (name != STRIDE_IDLE_NAME) {
    root.fail(fmt::format("fmi-ls-name is \"{}\"; expected \"{}\", in the namespace {}",
                          name.value_or(""), STRIDE_IDLE_NAME, kNamespace));
  }
  const std::string version = root.attribute(kNamespace, "fmi-ls-version").value_or("");
  if (!version.starts_with("1.")) {
    root.fail(fmt::format("fmi-ls-version=\"{}\" is not supported; expected 1.0.0", version),
              "take the manifest (" STRIDE_IDLE_MANIFEST
              ") out of the FMU to use it without idle "
              "skipping");
  }
  return !version.starts_with("1.0");
}

class ManifestReader {
 public:
  explicit ManifestReader(core::UnitDescription& unit) : unit_(unit) {}

  void read(const xml::Element& root) {
    const bool is_later = check_head(root);
    for (const xml::Element& element : root.children()) {
      if (element.name().local == "Input") {
        read_input(element);
      } else if (element.name().local == "Output") {
        read_output(element);
      } else if (!is_later) {
        element.fail(
            fmt::format("{} has no meaning here; expected <Input> or <Output>", element.tag()));
      }
    }
    unit_.promises_idle = true;
  }

 private:
  void read_input(const xml::Element& element) {
    core::Variable& input = find(element, core::Causality::Input, "deadband");
    input.deadband = element.required_number<double>("deadband");
    if (input.deadband >= 0 && std::isfinite(input.deadband)) return;
    element.fail(fmt::format("deadband=\"{}\" of '{}': expected a finite number, at least 0",
                             *element.attribute("deadband"), input.name));
  }

  void read_output(const xml::Element& element) {
    core::Variable& output = find(element, core::Causality::Output, "tolerance");
    const double tolerance = element.required_number<double>("tolerance");
    if (!(tolerance > 0 && std::isfinite(tolerance))) {
      element.fail(fmt::format("tolerance=\"{}\" of '{}': expected a finite number above 0",
                               *element.attribute("tolerance"), output.name));
    }
    output.tolerance = tolerance;
    output.has_derivative = element.flag("hasDerivative");
    if (output.has_derivative && unit_.max_output_derivative_order == 0) {
      element.fail(
          fmt::format("hasDerivative=\"true\" of '{}': the unit's "
                      "maxOutputDerivativeOrder is 0, so no output has one",
                      output.name));
    }
  }

  core::Variable& find(const xml::Element& element, core::Causality causality,
                       const char* attribute) {
    const std::string name = element.required("name");
    const auto reference = element.required_number<core::ValueReference>("valueReference");
    const auto place = unit_.find(name);
    if (!place) element.fail(fmt::format("the unit has no variable '{}'", name));
    core::Variable& variable = unit_.variables[*place];
    if (variable.reference != reference) {
      element.fail(fmt::format("the variable '{}' has the value reference {}, not {}", name,
                               variable.reference, reference));
    }
    if (variable.causality != causality || variable.type != core::ValueType::Float64) {
      element.fail(fmt::format("'{}' is {} {}; only a Float64 {} has a {}", name,
                               core::name_with_article(variable.type),
                               core::name(variable.causality), core::name(causality), attribute));
    }
    if (!listed_.insert(reference).second) element.fail(fmt::format("'{}' is listed twice", name));
    return variable;
  }

  core::UnitDescription& unit_;
  std::set<core::ValueReference> listed_;
};

}  // namespace

void parse_idle_manifest(const std::string& text, const std::string& shown_as,
                         core::UnitDescription& unit) {
  ManifestReader(unit).read(xml::Document::parse(text, shown_as).root());
}

void read_idle_manifest(const std::filesystem::path& file, const std::string& shown_as,
                        core::UnitDescription& unit) {
  ManifestReader(unit).read(xml::Document(file, shown_as).root());
}

}  // namespace stride::importer
