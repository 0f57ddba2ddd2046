// One channel can replace another: what they have in common is the same.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <tinyxml2.h>

#include "tests/build.h"
#include "tests/interfaces/unit/importer.h"

using namespace stride::tests;

namespace {

const std::vector<std::string> kChannels = {unit_library("nfc_channel"), unit_library("rf_channel"),
                                            unit_library("ideal_channel")};

/// The elements of inputs and outputs, but for what may differ: their order, what they mean,
/// and how they start.
std::vector<std::string> connectors(const std::string& library) {
  const std::string xml = UnitLibrary(library).describe();
  tinyxml2::XMLDocument document;
  REQUIRE(document.Parse(xml.c_str()) == tinyxml2::XML_SUCCESS);
  std::vector<std::string> found;
  const auto* variables = document.RootElement()->FirstChildElement("ModelVariables");
  for (const auto* v = variables->FirstChildElement(); v != nullptr; v = v->NextSiblingElement()) {
    const char* causality = v->Attribute("causality");
    if (causality == nullptr) continue;
    if (causality != std::string("input") && causality != std::string("output")) continue;
    static const std::set<std::string> kMayDiffer = {"valueReference", "description", "start",
                                                     "clocks"};
    if (v->Attribute("name", "field_reach") != nullptr) continue;  // of the near field alone
    std::string text = v->Name();
    for (const auto* a = v->FirstAttribute(); a != nullptr; a = a->Next()) {
      if (kMayDiffer.count(a->Name()) != 0) continue;
      text += std::string(" ") + a->Name() + "=" + a->Value();
    }
    found.push_back(text);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_CASE("All channels have the same inputs and outputs, of the same types, units and ranges") {
  const auto expected = connectors(kChannels.front());
  CHECK(expected.size() == 12 + 1 + 9 + 8);
  for (const std::string& channel : kChannels) {
    INFO(channel);
    CHECK(connectors(channel) == expected);
  }
}
