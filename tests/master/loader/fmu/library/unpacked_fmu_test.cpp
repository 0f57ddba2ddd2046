#include "master/loader/fmu/library/unpacked_fmu.h"

#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string unpack_error(const fs::path& path) {
  return input_error([&] { importer::UnpackedFmu(path, {"system.ssd", 7}); });
}

}  // namespace

TEST_CASE("an FMU has a description at its top") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "unit.fmu", {{"modelDescription.xml", "<x/>"}});
  CHECK(read(importer::UnpackedFmu(path).folder() / "modelDescription.xml") == "<x/>");
  CHECK_THAT(unpack_error(make_zip(scratch / "other.fmu", {{"readme", "x"}})),
             Contains("no modelDescription.xml"));
  const fs::path shown = "p.ssp/unit.fmu";
  CHECK_THAT(input_error([&] { importer::UnpackedFmu(scratch / "other.fmu", {}, shown); }),
             Contains("'p.ssp/unit.fmu' has no modelDescription.xml"));
  const std::string text =
      unpack_error(scratch.write("text.fmu", "This is not an archive at all."));
  CHECK_THAT(text, Contains("system.ssd:7: ") && Contains("hint: expected an FMU"));
}

TEST_CASE("an FMU whose folder was packed, or with a name in another case, is taken as it is") {
  const Scratch scratch;
  const auto place = GENERATE(as<std::string>(), "top/modelDescription.xml",
                              "a/b/modelDescription.xml", "ModelDescription.XML");
  const auto path = make_zip(scratch / "unit.fmu", {{place, "<x/>"},
                                                    {"__MACOSX/top/modelDescription.xml", "x"},
                                                    {".DS_Store", "x"},
                                                    {"readme.txt", "x"}});
  const importer::UnpackedFmu unpacked(path, {"system.ssd", 7});
  CHECK(read(unpacked.description()) == "<x/>");
  CHECK(unpacked.folder() == unpacked.description().parent_path());
  CHECK_THAT(unpacked.warning(),
             Contains("system.ssd:7: ") &&
                 Contains("unit.fmu' has its modelDescription.xml as '" + place + "'"));
}

TEST_CASE("an archive of several FMUs is none") {
  const Scratch scratch;
  CHECK_THAT(unpack_error(make_zip(scratch / "two.fmu", {{"a/modelDescription.xml", "<x/>"},
                                                         {"b/modelDescription.xml", "<x/>"}})),
             Contains("no modelDescription.xml at its top, and several below: "
                      "'a/modelDescription.xml', 'b/modelDescription.xml'") &&
                 Contains("pack the contents of each folder"));
}
