#include "master/loader/fmu/library/private_copy.h"

#include <optional>
#include <set>
#include <string>

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using importer::read_libraries;

TEST_CASE("in a private copy the libraries of a unit have other names, and all else its own") {
  const importer::UnitLibraries libraries = read_libraries(fmi2_library("bundling_3"));
  REQUIRE(libraries.needed.size() == 1);
  std::optional<importer::PrivateCopy> copy(std::in_place, libraries, std::set<std::string>{});
  const fs::path library = copy->library();
  CHECK(library.filename() == "bundling_3.so");
  const fs::path top = library.parent_path().parent_path().parent_path();
  CHECK(fs::equivalent(top / "modelDescription.xml",
                       build_folder() / "tests/test_units/bundling_3/modelDescription.xml"));
  const importer::UnitLibraries renamed = read_libraries(library);
  REQUIRE(renamed.needed.size() == 1);
  const importer::NeededLibrary& own = renamed.needed[0];
  CHECK(own.name != libraries.needed[0].name);
  CHECK(own.name.size() == libraries.needed[0].name.size());
  CHECK(own.file == library.parent_path() / own.name);
  CHECK_FALSE(own.is_loaded);
  CHECK(importer::exported_names(own.file) == importer::exported_names(libraries.needed[0].file));
  copy.reset();
  CHECK_FALSE(fs::exists(top));
}
