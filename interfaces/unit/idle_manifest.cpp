#include "interfaces/unit/idle_manifest.h"

#include <stride/idle.h>

#include "interfaces/unit/xml_writer.h"

namespace stride::kit {
namespace {

XmlWriter& open(XmlWriter& xml, const char* element, const Variable& row, std::size_t reference) {
  return xml.open(element)
      .attribute("name", row.name)
      .attribute("valueReference", static_cast<std::int64_t>(reference));
}

}  // namespace

std::string idle_manifest(const Unit& unit, const Table& table) {
  if (!unit.info().promises_idle) return {};
  XmlWriter xml;
  xml.open("fmiLayeredStandardManifest")
      .attribute("xmlns:fmi-ls", "http://fmi-standard.org/fmi-ls-manifest")
      .attribute("fmi-ls:fmi-ls-name", STRIDE_IDLE_NAME)
      .attribute("fmi-ls:fmi-ls-version", STRIDE_IDLE_VERSION)
      .attribute("fmi-ls:fmi-ls-description", "The unit can promise to be idle.");
  for (std::size_t i = 0; i < table.size(); ++i) {
    const Variable& row = table.row(i);
    if (row.deadband.value_or(0) > 0) {
      open(xml, "Input", row, i).attribute("deadband", *row.deadband).close();
    }
    if (row.tolerance) {
      open(xml, "Output", row, i).attribute("tolerance", *row.tolerance);
      if (row.derivative != nullptr) xml.attribute("hasDerivative", true);
      xml.close();
    }
  }
  return xml.close().text();
}

}  // namespace stride::kit
