#include "master/importer/unpacked_fmu.h"

#include "tests/master/importer/support.h"

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
  CHECK_THAT(unpack_error(make_zip(scratch / "nested.fmu", {{"top/modelDescription.xml", "x"}})),
             Contains("it is in the folder 'top'"));
  const fs::path shown = "p.ssp/unit.fmu";
  CHECK_THAT(input_error([&] { importer::UnpackedFmu(scratch / "other.fmu", {}, shown); }),
             Contains("'p.ssp/unit.fmu' has no modelDescription.xml"));
  const std::string text =
      unpack_error(scratch.write("text.fmu", "This is not an archive at all."));
  CHECK_THAT(text, Contains("system.ssd:7: ") && Contains("hint: expected an FMU"));
}
