#include "master/base/files/loose_path.h"

#include <fstream>

#include <catch2/catch.hpp>

#include "tests/scratch_folder.h"

using namespace stride::tests;
using stride::core::find_loosely;
namespace fs = std::filesystem;

namespace {

void add(const ScratchFolder& folder, const std::string& name) {
  fs::create_directories((folder / name).parent_path());
  std::ofstream(folder / name) << "x";
}

}  // namespace

TEST_CASE("a name that is not there is the only one that differs by case or composition") {
  const ScratchFolder folder;
  add(folder, "Resources/Gro\u0308\u00DFe.FMU");
  CHECK(find_loosely(folder / "", "resources/gr\u00F6\u00DFe.fmu") ==
        folder / "Resources/Gro\u0308\u00DFe.FMU");
  CHECK(find_loosely(folder / "Resources", "../resources/GR\u00F6\u00DFe.fmu") ==
        folder / "Resources/Gro\u0308\u00DFe.FMU");
  CHECK_FALSE(find_loosely(folder / "", "resources/gr\u00E4\u00DFe.fmu"));
  CHECK_FALSE(find_loosely(folder / "", "/resources/gr\u00F6\u00DFe.fmu"));
}

TEST_CASE("a name that may mean two files means none") {
  const ScratchFolder folder;
  add(folder, "A.fmu");
  add(folder, "a.FMU");
  CHECK_FALSE(find_loosely(folder / "", "a.fmu"));
  CHECK(find_loosely(folder / "", "A.fmu") == folder / "A.fmu");
}
