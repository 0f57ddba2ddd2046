#include "master/loader/fmu/library/loaded_image.h"

#include <memory>

#include <dlfcn.h>

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using importer::is_loaded_from_equal;

TEST_CASE("a loaded library is compared with a file of its name, also when its own is gone") {
  const Scratch scratch;
  const std::string bytes =
      read(unit_library("bundling").parent_path() / "libstride_test_bundled.so");
  const fs::path file = scratch.write("libown.so", bytes);
  const std::unique_ptr<void, int (*)(void*)> handle(::dlopen(file.c_str(), RTLD_NOW), &::dlclose);
  REQUIRE(handle != nullptr);
  const fs::path same = scratch.write("same.so", bytes);
  std::string changed = bytes;
  changed[changed.find("stride_test_answer")] = 'x';
  const fs::path other = scratch.write("other.so", changed);
  CHECK(is_loaded_from_equal(file, same));
  fs::remove(file);
  CHECK(is_loaded_from_equal(file, same));
  CHECK_FALSE(is_loaded_from_equal(file, other));
  CHECK_FALSE(is_loaded_from_equal(file, scratch / "absent.so"));
  CHECK(is_loaded_from_equal("libabsent.so", other));
}
