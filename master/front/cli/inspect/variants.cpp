#include "master/front/cli/inspect/variants.h"

#include <algorithm>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "master/base/xml/document.h"
#include "master/front/cli/terminal/table.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

/// One that cannot be read does not keep the others from being listed.
std::string name_of(const ssp::Files& files, const fs::path& file) {
  try {
    return xml::Document(file, files.shown(file)).root().attribute_or("name");
  } catch (const std::exception&) {
    return "(cannot be read)";
  }
}

}  // namespace

std::string variant_table(ssp::Files& files, const fs::path& scenario) {
  const fs::path shown = files.scenario_file(scenario);
  const std::vector<fs::path> variants = files.variants(scenario, shown);
  if (variants.size() < 2) return "";
  Table table({{"file"}, {"system"}, {""}});
  for (const fs::path& variant : variants) {
    table.add({files.shown(variant), name_of(files, variant),
               variant.filename() == shown.filename() ? "this one" : ""});
  }
  return "\nVariants\n" + table.text();
}

}  // namespace stride::cli
