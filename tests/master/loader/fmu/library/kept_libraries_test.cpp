#include "master/loader/fmu/library/kept_libraries.h"

#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;

TEST_CASE("a library that cannot be unloaded is used again by an FMU with the same content") {
  const Scratch scratch;
  fs::copy_file(test_fmu("registrar"), scratch / "copy.fmu");
  const auto library_of = [](const fs::path& fmu) {
    return importer::Fmu::load(fmu)->load_library().get();
  };
  const importer::SharedLibrary* const first = library_of(test_fmu("registrar"));
  CHECK(library_of(test_fmu("registrar")) == first);
  CHECK(library_of(scratch / "copy.fmu") == first);
  CHECK_FALSE(importer::KeptLibraries::of_process().is_empty());
  CHECK(importer::KeptLibraries::of_process().find("another") == nullptr);
  CHECK(library_of(test_fmu("single")) != first);
}
