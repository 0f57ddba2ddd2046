#include "master/loader/fmu/library/needed_libraries.h"

#include <optional>

#include <dlfcn.h>

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using importer::LibraryUse;
using importer::read_libraries;

namespace {

constexpr const char* kBundled = "libstride_test_bundled.so";

}  // namespace

TEST_CASE("a unit needs the libraries that it brings along, and in turn those that they need") {
  const auto libraries = read_libraries(unit_library("bundling"));
  const auto& needed = libraries.needed;
  REQUIRE(needed.size() == 1);
  CHECK(needed[0].name == kBundled);
  CHECK(fs::equivalent(needed[0].file, unit_library("bundling").parent_path() / kBundled));
  CHECK_FALSE(needed[0].is_loaded);
}

TEST_CASE("what comes with the compilers is no library that a unit needs") {
  CHECK(read_libraries(unit_library("minimal")).needed.empty());
  for (const char* name : {"libc.so.6", "/usr/lib/libm.so.6", "libstdc++.so.6", "libgcc_s.so.1",
                           "ld-linux-x86-64.so.2"}) {
    CAPTURE(name);
    CHECK(importer::is_of_compiler(name));
  }
  for (const char* name : {"libz.so.1", "libcrypto.so.3", "libm_of_others.so", ""}) {
    CAPTURE(name);
    CHECK_FALSE(importer::is_of_compiler(name));
  }
}

TEST_CASE("what is no library needs none") {
  const Scratch scratch;
  CHECK(read_libraries(scratch / "absent.so").needed.empty());
  CHECK(read_libraries(scratch.write("text.so", "no library")).needed.empty());
}

TEST_CASE("a library that another unit needs, too, may outlive the first one") {
  auto libraries = read_libraries(unit_library("bundling"));
  const LibraryUse first(libraries);
  const LibraryUse first_again(libraries);
  CHECK_FALSE(first.may_be_outlived());
  libraries.file = "second.so";
  std::optional<LibraryUse> second(std::in_place, libraries);
  CHECK(first.may_be_outlived());
  second.reset();
  CHECK_FALSE(first.may_be_outlived());
}

TEST_CASE("a library that was there before a unit may outlive it") {
  const fs::path library = unit_library("bundling").parent_path() / kBundled;
  void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  REQUIRE(handle != nullptr);
  const auto libraries = read_libraries(unit_library("bundling"));
  const auto& needed = libraries.needed;
  ::dlclose(handle);
  REQUIRE(needed.size() == 1);
  CHECK(needed[0].is_loaded);
  CHECK_FALSE(needed[0].is_displaced());
  CHECK(LibraryUse(libraries).may_be_outlived());
}

TEST_CASE("a library that is never unloaded outlives its units") {
  const auto libraries = read_libraries(unit_library("registrar"));
  REQUIRE(libraries.needed.size() == 1);
  CHECK(libraries.needed[0].part.stays_loaded);
  CHECK(LibraryUse(libraries).may_be_outlived());
}
