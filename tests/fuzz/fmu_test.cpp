// Whatever an FMU holds, loading its description gives a description or a core::Error.
#include "master/importer/fmu.h"

#include <string>

#include <catch2/catch.hpp>

#include "master/importer/idle_manifest.h"
#include "master/importer/model_description.h"
#include "tests/build.h"
#include "tests/fuzz/mutator.h"
#include "tests/master/importer/support.h"

using namespace stride;
using namespace stride::tests;

namespace {

/// Units with all types, and the first one with messages.
const fs::path kFmu = test_fmu("types");

}  // namespace

TEST_CASE("a mutated model description is read or refused, and never anything else") {
  const std::string unit = GENERATE("types", "fmi2_types", "fmi2_relaxation");
  CAPTURE(unit);
  const importer::UnpackedFmu unpacked(test_fmu(unit));
  const std::string xml = read(unpacked.folder() / "modelDescription.xml");
  REQUIRE_NOTHROW(importer::parse_model_description(xml, "x.xml"));
  Mutator mutator(20240118);
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    try {
      const auto read = importer::parse_model_description(mutator.mutate(xml), "x.xml");
      ++accepted;
      if (read.fmi2) CHECK(read.fmi2->references.size() == read.variables.size());
    } catch (const core::Error& error) {
      ++refused;
      CHECK(error.kind() == core::Error::Kind::Input);
      CHECK(error.context().where.file == "x.xml");
    }
  }
  CHECK(accepted > 50);
  CHECK(refused > 1000);
}

TEST_CASE("a mutated idle manifest is read or refused, and never anything else") {
  const importer::UnpackedFmu unpacked(test_unit_folder() / "idler.fmu");
  const std::string xml = read(unpacked.folder() / STRIDE_IDLE_MANIFEST);
  const auto described =
      importer::read_model_description(unpacked.folder() / "modelDescription.xml");
  Mutator mutator(20240120);
  int accepted = 0;
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    core::UnitDescription unit = described;
    try {
      importer::parse_idle_manifest(mutator.mutate(xml), "x.xml", unit);
      ++accepted;
      CHECK(unit.promises_idle);
      for (const core::Variable& variable : unit.variables) {
        CHECK(variable.deadband >= 0);
        CHECK(variable.tolerance.value_or(1) > 0);
      }
    } catch (const core::Error& error) {
      ++refused;
      CHECK(error.kind() == core::Error::Kind::Input);
      CHECK(error.context().where.file == "x.xml");
    }
  }
  CHECK(accepted > 50);
  CHECK(refused > 1000);
}

TEST_CASE("a mutated archive is unpacked or refused, and leaves nothing behind") {
  const Scratch scratch;
  const std::string bytes = read(kFmu);
  Mutator mutator(20240119);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    const fs::path file = scratch.write("x.fmu", mutator.mutate(bytes));
    try {
      importer::Fmu::load(file);
    } catch (const core::Error& error) {
      ++refused;
      CHECK(error.kind() == core::Error::Kind::Input);
    }
  }
  CHECK(refused > 30);
  for (const auto& entry : fs::recursive_directory_iterator(scratch / "tmp")) {
    INFO(entry.path().string());
    CHECK(entry.path().filename() != "modelDescription.xml");
  }
}
