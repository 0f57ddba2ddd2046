#include "master/loader/fmu/fmu.h"

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using importer::Fmu;

TEST_CASE("an archive, its folder and the bare library are the same unit") {
  const Scratch scratch;
  const importer::UnpackedFmu unpacked(test_fmu("types"));
  const auto archive = Fmu::load(test_fmu("types"));
  const auto folder = Fmu::load(unpacked.folder());
  const auto library = Fmu::load(unit_library("types"));
  for (const auto& fmu : {archive, folder, library}) {
    CHECK(fmu->description()->model_identifier == "types");
    CHECK(fmu->description()->instantiation_token == archive->description()->instantiation_token);
    CHECK(fmu->description()->variables.size() == archive->description()->variables.size());
    CHECK_NOTHROW(fmu->instantiate("unit"));
  }
}

TEST_CASE("a description is read without loading the library") {
  const Scratch scratch;
  const auto fmu = Fmu::load(make_raw_fmu(scratch, "raw_with_missing_library"));
  CHECK(fmu->description()->model_name == "test");
  CHECK_THAT(input_error([&] { fmu->load_library(); }), Contains("libstride_test_absent.so"));
  CHECK_THAT(input_error([&] { fmu->instantiate("unit"); }), Contains("libstride_test_absent.so"));
}

TEST_CASE("an FMU without binaries for this platform can still be inspected") {
  const Scratch scratch;
  scratch.write("unit/modelDescription.xml", description_text("tank"));
  scratch.write("unit/binaries/x86_64-windows/tank.dll", "");
  const auto fmu = Fmu::load(scratch / "unit", {"system.ssd", 12});
  CHECK(fmu->description()->model_identifier == "tank");
  CHECK_THAT(input_error([&] { fmu->instantiate("unit"); }),
             Contains("system.ssd:12: unit 'unit': ") && Contains("it has x86_64-windows"));
}

TEST_CASE("an instance keeps the FMU and its unpacked files alive") {
  const Scratch scratch;
  auto fmu = Fmu::load(test_fmu("stateless"));
  const core::ValueReference note = fmu->description()->variables.back().reference;
  auto unit = fmu->instantiate("unit");
  fmu.reset();
  core::ValueBlock text(core::ValueType::String, 1);
  unit->get(std::span(&note, 1), text);
  CHECK(text.strings()[0] == "text from the resources");
  const auto folders = [] {
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(archive::TemporaryFolder::parent())) {
      count += entry.is_directory() ? 1 : 0;
    }
    return count;
  };
  CHECK(folders() == 1);
  unit.reset();
  CHECK(folders() == 0);
}

TEST_CASE("a bare library uses the resources folder beside it") {
  const Scratch scratch;
  fs::copy_file(unit_library("stateless"), scratch / "stateless.so");
  CHECK_THAT(input_error([&] { Fmu::load(scratch / "stateless.so"); }),
             Contains("its resource note.txt is missing"));
  scratch.write("resources/note.txt", "beside it");
  const auto fmu = Fmu::load(scratch / "stateless.so");
  const auto unit = fmu->instantiate("unit");
  core::ValueBlock text(core::ValueType::String, 1);
  unit->get(std::span(&fmu->description()->variables.back().reference, 1), text);
  CHECK(text.strings()[0] == "beside it");
}

TEST_CASE("a bare library that was not made with the kit is refused with advice") {
  CHECK_THAT(input_error([] { Fmu::load(raw_library("raw")); }),
             Contains("contains no model description") && Contains("give an FMU"));
}

TEST_CASE("errors in the description are located in the FMU") {
  const Scratch scratch;
  const auto path = make_zip(scratch / "old.fmu",
                             {{"modelDescription.xml", "<fmiModelDescription fmiVersion='4.0'/>"}});
  CHECK_THAT(input_error([&] { Fmu::load(path); }),
             Contains("old.fmu/modelDescription.xml:1: fmiVersion=\"4.0\" is not supported"));
  CHECK_THAT(input_error([] {
               Fmu::load("/absent.fmu", {"system.ssd", 9});
             }),
             Contains("system.ssd:9: there is no file '/absent.fmu'"));
}

TEST_CASE("a unit that allows one instance per process gets one at a time") {
  const Scratch scratch;
  const auto fmu = Fmu::load(test_fmu("single"));
  const auto copy = Fmu::load(test_fmu("single"));
  REQUIRE(fmu->description()->single_instance);
  auto first = fmu->instantiate("first");
  CHECK_THAT(input_error([&] {
               fmu->instantiate("second", {.where = {"system.ssd", 5}});
             }),
             Contains("system.ssd:5: unit 'second': ") && Contains("only once per process"));
  CHECK_THROWS_AS(copy->instantiate("second"), core::Error);
  first.reset();
  CHECK_NOTHROW(copy->instantiate("second"));
}

TEST_CASE("a unit that refuses does not stay the only instance") {
  const Scratch scratch;
  const auto fmu =
      Fmu::load(make_raw_fmu(scratch, "raw", "canBeInstantiatedOnlyOncePerProcess=\"true\""));
  CHECK_THROWS_AS(fmu->instantiate("refuses"), core::Error);
  CHECK_NOTHROW(fmu->instantiate("unit"));
}

TEST_CASE("that a unit needs its tool is logged") {
  const Scratch scratch;
  const auto fmu = Fmu::load(make_raw_fmu(scratch, "raw", "needsExecutionTool=\"true\""));
  std::string logged;
  fmu->instantiate("unit",
                   {.log = [&](const std::string& unit, importer::Status, const std::string&,
                               const std::string& message) { logged += unit + ": " + message; }});
  CHECK_THAT(logged, Contains("unit: ") && Contains("needs the tool that made it"));
}
