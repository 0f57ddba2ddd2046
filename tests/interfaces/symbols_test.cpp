// What a library made with the unit kit exports: the FMI 3.0 entry table, those of idle skipping
// and of what messages say, its self-description, and nothing else, so that units cannot disturb
// each other.
#include <array>
#include <cstdio>
#include <memory>
#include <set>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <dlfcn.h>

#include <stride/describe.h>
#include <stride/fmi3.h>
#include <stride/idle.h>

#include "tests/build.h"

namespace {

std::set<std::string> exported_symbols(const std::string& library) {
  const std::string command = STRIDE_NM " -D --defined-only --format=posix '" + library + "'";
  const std::unique_ptr<FILE, decltype(&pclose)> pipe(popen(command.c_str(), "r"), &pclose);
  REQUIRE(pipe != nullptr);
  std::set<std::string> names;
  std::array<char, 4096> line;
  while (std::fgets(line.data(), line.size(), pipe.get()) != nullptr) {
    std::string name;
    std::istringstream(line.data()) >> name;
    names.insert(name);
  }
  return names;
}

std::set<std::string> expected_symbols() {
  std::set<std::string> names = {"strideModelDescription", "strideIdleManifest"};
#define ADD(name) names.insert("fmi3" #name);
  FMI3_FUNCTIONS(ADD)
#undef ADD
#define ADD(name) names.insert("stride" #name);
  STRIDE_IDLE_FUNCTIONS(ADD)
  STRIDE_DESCRIBE_FUNCTIONS(ADD)
#undef ADD
  return names;
}

}  // namespace

TEST_CASE("a unit's library exports the entry tables and its self-description alone") {
  for (const char* unit : {"minimal", "types"}) {
    const std::string library = stride::tests::unit_library(unit);
    CAPTURE(library);
    CHECK(exported_symbols(library) == expected_symbols());
    void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    REQUIRE(handle != nullptr);
    for (const std::string& name : expected_symbols()) {
      CAPTURE(name);
      CHECK(dlsym(handle, name.c_str()) != nullptr);
    }
    dlclose(handle);
  }
}
