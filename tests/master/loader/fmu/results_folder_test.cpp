// Instances in one process: each has a folder for its files, in STRIDE_RESULTS while it is made.
#include <filesystem>
#include <string>

#include "master/engine/port/capabilities/resetting.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;

namespace {

void set_text(core::Unit& unit, const importer::Fmu& fmu, const std::string& name,
              const std::string& text) {
  const core::UnitDescription& description = *fmu.description();
  core::ValueBlock block(core::ValueType::String, 1);
  block.strings()[0] = text;
  const core::ValueReference reference =
      description.variables[description.find(name).value()].reference;
  unit.set({&reference, 1}, block);
}

/// Initializes the unit, which writes a note into its folder.
void write_note(core::Unit& unit, const importer::Fmu& fmu) {
  set_text(unit, fmu, "attack", "note");
  set_text(unit, fmu, "call", "initialize");
  unit.enter_initialization(Time(), std::nullopt);
  unit.exit_initialization();
}

}  // namespace

TEST_CASE("each instance keeps the folder that it was made with, also when it is reset") {
  const Scratch scratch;
  const auto fmu = importer::Fmu::load(test_fmu("intruder"));
  const fs::path first = scratch / "first", second = scratch / "second";
  fs::create_directories(first);
  fs::create_directories(second);
  const auto one = fmu->instantiate("one", {.results = first});
  const auto other = fmu->instantiate("other", {.results = second});
  write_note(*one, *fmu);
  CHECK(fs::exists(first / "note.txt"));
  CHECK_FALSE(fs::exists(second / "note.txt"));
  fs::remove(first / "note.txt");
  write_note(*other, *fmu);
  CHECK(fs::exists(second / "note.txt"));
  CHECK_FALSE(fs::exists(first / "note.txt"));
  one->capability<core::Resetting>()->reset();
  write_note(*one, *fmu);
  CHECK(fs::exists(first / "note.txt"));
}
