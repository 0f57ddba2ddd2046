#include "master/system/ssp/signal_dictionary.h"

#include <catch2/catch.hpp>

#include "master/base/xml/document.h"
#include "master/system/ssp/ssp.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::core;
using namespace stride::ssp;
using namespace stride::tests;
using Catch::Contains;

namespace {

const std::string kNamespaces =
    " xmlns:ssb='http://ssp-standard.org/SSP1/SystemStructureSignalDictionary' "
    "xmlns:ssc='http://ssp-standard.org/SSP1/SystemStructureCommon'";

std::string dictionary(const std::string& entries, const std::string& version = "2.0") {
  return "<ssb:SignalDictionary version='" + version + "'" + kNamespaces + ">" + entries +
         "</ssb:SignalDictionary>";
}

std::map<std::string, SignalDictionary> read_dictionaries(const std::string& inside,
                                                          const std::filesystem::path& folder,
                                                          std::vector<std::string>& warnings) {
  const auto document = stride::xml::Document::parse(
      ssd("<ssd:SignalDictionaries>" + inside + "</ssd:SignalDictionaries>"), "x.ssd");
  Files files;
  Definitions definitions;
  definitions.units_of_measure["m"] = {{0, 1, 0, 0, 0, 0, 0, 0}, 1, 0};
  return read_signal_dictionaries(*document.root().child({kSsd, "SignalDictionaries"}),
                                  {files, {&folder, 1}, definitions, warnings});
}
std::map<std::string, SignalDictionary> read_dictionaries(
    const std::string& inside, const std::filesystem::path& folder = {}) {
  std::vector<std::string> warnings;
  return read_dictionaries(inside, folder, warnings);
}

const std::string kSpeed =
    "<ssb:DictionaryEntry name='speed'><ssc:Real unit='rpm'/></ssb:DictionaryEntry>"
    "<ssb:Units><ssc:Unit name='rpm'><ssc:BaseUnit s='-1'/></ssc:Unit></ssb:Units>";

}  // namespace

TEST_CASE("a dictionary is inline or in a file, with units of measure of its own") {
  const TemporaryFolder folder;
  folder.write("bus.ssb", dictionary(kSpeed, "1.0"));
  const bool is_inline = GENERATE(true, false);
  const auto all =
      is_inline
          ? read_dictionaries("<ssd:SignalDictionary name='bus'>" + dictionary(kSpeed) +
                              "</ssd:SignalDictionary>")
          : read_dictionaries("<ssd:SignalDictionary name='bus' source='bus.ssb'/>", folder / "");
  const auto& speed = all.at("bus").entries.at("speed");
  CHECK(speed.unit.name == "rpm");
  CHECK(speed.unit.meaning->exponents[2] == -1);
  CHECK(speed.type.has_value() == is_inline);  // SSP 1.0 says nothing of the width
}

TEST_CASE("a unit that a dictionary does not define is the system's, with a warning") {
  const auto entry = [](const std::string& unit) {
    return "<ssd:SignalDictionary name='bus'>" +
           dictionary("<ssb:DictionaryEntry name='s'><ssc:Float64 unit='" + unit +
                      "'/></ssb:DictionaryEntry>") +
           "</ssd:SignalDictionary>";
  };
  std::vector<std::string> warnings;
  const auto known = read_dictionaries(entry("m"), {}, warnings);
  CHECK(known.at("bus").entries.at("s").unit.meaning->exponents[1] == 1);
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("x.ssd:") && Contains("the unit 'm' is not defined"));
  const auto unknown = read_dictionaries(entry("furlong"), {}, warnings);
  CHECK_FALSE(unknown.at("bus").entries.at("s").unit.meaning);
  CHECK(warnings.size() == 1);
}

TEST_CASE("dictionaries that cannot be meant are refused") {
  const auto with = [](const std::string& entries) {
    return "<ssd:SignalDictionary name='bus'>" + dictionary(entries) + "</ssd:SignalDictionary>";
  };
  const std::string entry = "<ssb:DictionaryEntry name='a'><ssc:Boolean/></ssb:DictionaryEntry>";
  const auto [text, message] = GENERATE_COPY(table<std::string, std::string>({
      {with(entry + entry), "two entries are named 'a'"},
      {with("<ssb:Unit name='m'/>" + entry), "<ssb:Unit>"},
      {with(entry) + with(entry), "two signal dictionaries are named 'bus'"},
      {with("<ssb:DictionaryEntry name='a'><ssb:Boolean/></ssb:DictionaryEntry>"), "is not known"},
      {"<ssd:SignalDictionary name='bus'/>", "neither a source nor <ssb:SignalDictionary>"},
      {"<ssd:SignalDictionary name='bus' type='text/csv' source='a.csv'/>",
       "does not support signal dictionaries of the type 'text/csv'"},
      {"<ssd:SignalDictionary name='bus' source='none.ssb'/>", "the file does not exist"},
  }));
  CHECK_THROWS_WITH(read_dictionaries(text), Contains(message));
}

TEST_CASE("an entry of a dictionary may be an array") {
  const auto all = read_dictionaries(
      "<ssd:SignalDictionary name='bus'>" +
      dictionary("<ssb:DictionaryEntry name='x'><ssc:Float64/><ssc:Dimension size='2'/>"
                 "<ssc:Dimension sizeConnector='n'/></ssb:DictionaryEntry>") +
      "</ssd:SignalDictionary>");
  const auto& dimensions = all.at("bus").entries.at("x").dimensions;
  REQUIRE(dimensions.size() == 2);
  CHECK(dimensions[0].size == 2);
  CHECK(dimensions[1].size_connector == "n");
}
