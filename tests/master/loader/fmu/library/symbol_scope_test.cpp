#include "master/loader/fmu/library/symbol_scope.h"

#include <memory>

#include <dlfcn.h>

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using importer::find_symbol_scope;
using importer::read_libraries;
using importer::SymbolScope;

TEST_CASE("a unit whose symbols nothing else has is bound as usual") {
  for (const fs::path& library : {unit_library("minimal"), unit_library("types"),
                                  fmi2_library("fmi2_relaxation"), raw_library("raw")}) {
    CAPTURE(library);
    const SymbolScope scope = find_symbol_scope(read_libraries(library));
    CHECK(scope.flags == 0);
    CHECK(scope.warning == "");
  }
}

TEST_CASE("a unit with a symbol that another library has is bound to its own first") {
  if (kSanitized) return;
  const SymbolScope scope = find_symbol_scope(read_libraries(fmi2_library("own_checksum")));
  CHECK(scope.flags == RTLD_DEEPBIND);
  CHECK(scope.warning == "");
}

TEST_CASE("a library that a unit brings along is bound to its own symbols first, too") {
  if (kSanitized) return;
  CHECK(find_symbol_scope(read_libraries(fmi2_library("bundling_1"))).flags == 0);
  const importer::UnitLibraries libraries = read_libraries(fmi2_library("bundling_3"));
  REQUIRE(libraries.needed.size() == 1);
  CHECK(find_symbol_scope(libraries).flags == RTLD_DEEPBIND);
  // for another unit that needs it as well
  const fs::path file = libraries.needed[0].file;
  const std::unique_ptr<void, int (*)(void*)> handle(::dlopen(file.c_str(), RTLD_NOW), &::dlclose);
  const importer::UnitLibraries again = read_libraries(fmi2_library("bundling_3"));
  REQUIRE(again.needed.size() == 1);
  CHECK(again.needed[0].is_loaded);
  CHECK(find_symbol_scope(again).flags == RTLD_DEEPBIND);
}

TEST_CASE("a sanitizer forbids that a unit is bound to its own symbols first") {
  if (!kSanitized) return;
  const SymbolScope scope = find_symbol_scope(read_libraries(fmi2_library("own_checksum")));
  CHECK(scope.flags == 0);
  CHECK_THAT(scope.warning, Contains("'crc32'"));
}

TEST_CASE("what is no library has no symbols of its own") {
  const Scratch scratch;
  CHECK(find_symbol_scope(read_libraries(scratch.write("text.so", "no library"))).flags == 0);
}
