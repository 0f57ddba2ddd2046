// The files of SSP, and stride's annotation in them.
#include "master/base/archive/zip.h"
#include "master/base/xml/document.h"
#include "master/system/declaration/annotation.h"
#include "master/system/declaration/scenario.h"
#include "master/system/ssp/complete.h"
#include "master/system/ssp/package.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"
#include "tests/master/system/ssp/support.h"

namespace stride::tests {
namespace {

using scenario::read_scenario;

/// Completing what was read gives a text that reads back.
void check_completion(const std::filesystem::path& file, const scenario::Scenario& read) {
  static const auto description = sample_description();
  ssp::Descriptions known;
  for (const auto& component : read.system.components) known.emplace(component.name, description);
  const std::string completed = ssp::complete(file, known);
  const auto again = write_file("completed/x.ssd", completed);
  ensure(ssp::complete(again, known) == completed, "what is complete stays as it is");
}

void read_ssd(const std::string& bytes) {
  const auto file = write_file("x.ssd", bytes);
  refusing_input("", [&] {
    const scenario::Scenario read = read_scenario(file);
    check_completion(file, read);
    ssp::Files files;
    ssp::package_contents(file, files, [&](const auto&, const auto&) { return file; });
  });
}

void read_ssp(const std::string& bytes) {
  refusing_input("", [&] { read_scenario(write_file("x.ssp", bytes)); });
  ensure(is_tidy(), "archives leave nothing behind");
}

std::string ssp_bytes() {
  const auto file = working_path("seed.ssp");
  archive::Contents contents;
  contents["SystemStructure.ssd"].text = ssd_with("<ssd:Component name=\"a\" source=\"a.fmu\"/>");
  contents["resources/table.csv"].text = std::string(2000, '7');
  archive::write_zip(file, contents);
  return content_of(file);
}

/// A scenario that binds values.
const std::string kBound = ssd(R"(<ssd:System name="root"><ssd:ParameterBindings>
    <ssd:ParameterBinding source="values.ssv"><ssd:ParameterMapping source="map.ssm"/>
    </ssd:ParameterBinding></ssd:ParameterBindings>
  <ssd:Elements><ssd:Component name="a" source="a.fmu"/></ssd:Elements></ssd:System>)");

void read_bound(const std::string& folder) {
  const auto file = write_file(folder + "/x.ssd", kBound);
  refusing_input("", [&] { read_scenario(file); });
}

void read_ssv(const std::string& bytes) {
  copy_seed("ssm/both.ssm", "values/map.ssm");
  write_file("values/values.ssv", bytes);
  read_bound("values");
}

void read_ssm(const std::string& bytes) {
  copy_seed("ssv/values.ssv", "mapping/values.ssv");
  write_file("mapping/map.ssm", bytes);
  read_bound("mapping");
}

void read_ssb(const std::string& bytes) {
  static const auto file = write_file(
      "bus/x.ssd",
      ssd_with("<ssd:Component name=\"a\" source=\"a.fmu\"/>"
               "<ssd:SignalDictionaryReference name=\"r\" dictionary=\"d\"/>",
               "<ssd:Connections><ssd:Connection startElement=\"a\" startConnector=\"m\" "
               "endElement=\"r\" endConnector=\"e\"/></ssd:Connections>"
               "<ssd:SignalDictionaries><ssd:SignalDictionary name=\"d\" source=\"bus.ssb\"/>"
               "</ssd:SignalDictionaries>"));
  write_file("bus/bus.ssb", bytes);
  refusing_input("", [&] { read_scenario(file); });
}

void read_annotation(const std::string& bytes) {
  const std::string text =
      ssd("<ssd:System name=\"root\"/>\n<ssd:Annotations>" + bytes + "</ssd:Annotations>");
  refusing_input("x.ssd",
                 [&] { scenario::read_annotation(xml::Document::parse(text, "x.ssd").root()); });
}

const Registration kSspParsers(
    "ssp", {
               {.name = "ssd", .read = read_ssd, .seed_files = {"tests/fuzz/seeds/ssd"}},
               {.name = "ssp_archive",
                .read = read_ssp,
                .make_seed = ssp_bytes,
                .alphabet = std::string("PK\x01\x02\x03\x04\x05\x06/.\0\xff", 12)},
               {.name = "ssv", .read = read_ssv, .seed_files = {"tests/fuzz/seeds/ssv"}},
               {.name = "ssm", .read = read_ssm, .seed_files = {"tests/fuzz/seeds/ssm"}},
               {.name = "ssb", .read = read_ssb, .seed_files = {"tests/fuzz/seeds/ssb"}},
               {.name = "annotation",
                .read = read_annotation,
                .seed_files = {"tests/fuzz/seeds/annotation"}},
           });

}  // namespace
}  // namespace stride::tests
