#include "master/observe/recorders/provenance.h"

#include <filesystem>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "master/base/error.h"
#include "tests/master/system/ssp/support.h"

using namespace stride::recorders;
using Catch::Contains;
using stride::tests::TemporaryFolder;

namespace {

Provenance of(const TemporaryFolder& folder) {
  stride::core::FileDigests digests;
  return {.version = "1",
          .sources = {make_source("the scenario", folder / "a.ssd", digests),
                      make_source("a unit", folder / "unit", digests)}};
}

}  // namespace

TEST_CASE("what results were made from is told apart by its content") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "unit/two");
  folder.write("a.ssd", "abc");
  folder.write("unit/one", "1");
  folder.write("unit/two/three", "3");
  const Provenance before = of(folder);
  CHECK(before.sources[0].sha256 ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(differences(before, of(folder)).empty());

  folder.write("unit/two/three", "4");
  CHECK_THAT(differences(before, of(folder)).at(0),
             Contains("a unit, ") && Contains("unit, is not"));
  folder.write("unit/two/three", "3");
  folder.write("unit/four", "");
  CHECK(differences(before, of(folder)).size() == 1);
  folder.write("a.ssd", "abd");
  CHECK(differences(before, of(folder)).size() == 2);

  Provenance other = before;
  other.version = "2";
  other.sources.pop_back();
  const auto texts = differences(before, other);
  REQUIRE(texts.size() == 2);
  CHECK(texts[0] == "it is of stride 1, and this is 2");
  CHECK_THAT(texts[1], Contains("is not used any more"));
  CHECK_THAT(differences(other, before).at(1), Contains("was not used"));
  CHECK_THROWS_AS(of(TemporaryFolder()), stride::core::Error);
}

TEST_CASE("files of the same name are told apart by their order, and branches are left out") {
  const Provenance before{
      .version = "1", .sources = {{"a unit", "/one/a.fmu", "00"}, {"a unit", "/two/a.fmu", "11"}}};
  Provenance now = before;
  now.sources[0].path = "/moved/one/a.fmu";
  now.sources.push_back({kBranchesFile, "/branches.xml", "22"});
  CHECK(differences(before, now).empty());
  CHECK(differences(now, before).empty());
  now.sources[1].sha256 = "12";
  CHECK(differences(before, now) ==
        std::vector<std::string>{"a unit, /two/a.fmu, is not what it was"});
  now.sources.erase(now.sources.begin());
  CHECK(differences(before, now).size() == 2);
}

TEST_CASE("provenance is read back from its JSON") {
  const Provenance made{"1",
                        "2026-01-01T00:00:00Z",
                        "desk",
                        {{{"run", "a b", "--quiet"}, "/x y"}},
                        {{"a unit", "/u", "00"}},
                        {"a=b.fmu"},
                        {"a.x=1", "a.y=two words"}};
  CHECK(to_json(made)["commands"][0]["text"] == "stride run 'a b' --quiet");
  const Provenance read = provenance_of(to_json(made));
  CHECK(read.version == "1");
  CHECK(read.date == made.date);
  CHECK(read.host == "desk");
  REQUIRE(read.commands.size() == 1);
  CHECK(read.commands[0].words == made.commands[0].words);
  CHECK(read.commands[0].folder == made.commands[0].folder);
  CHECK(read.swaps == made.swaps);
  CHECK(read.values == made.values);
  CHECK(read.sources == made.sources);
  CHECK_THROWS_AS(provenance_of(nlohmann::ordered_json::object()), nlohmann::json::exception);
}
