#include "master/base/process/loaded_object.h"

#include <cstdlib>
#include <iostream>
#include <string>

#include <catch2/catch.hpp>
#include <dlfcn.h>
#include <link.h>

using stride::core::loaded_object_at;
using stride::core::loaded_objects;

namespace {

int variable = 1;

const void* address_of(void (*function)()) { return reinterpret_cast<const void*>(function); }

}  // namespace

TEST_CASE("code and variables of one file have one object") {
  const link_map* const own = loaded_object_at(&variable);
  REQUIRE(own != nullptr);
  CHECK(loaded_object_at(address_of([] {})) == own);
  // a function that no sanitizer replaces
  const link_map* const c_library = loaded_object_at(::dlsym(RTLD_DEFAULT, "gnu_get_libc_version"));
  REQUIRE(c_library != nullptr);
  CHECK(c_library != own);
  CHECK(loaded_object_at(stderr) == c_library);
  CHECK(std::string(c_library->l_name).find("libc.so") != std::string::npos);
  CHECK(loaded_object_at(std::cout.rdbuf()) != own);
}

TEST_CASE("what is in no file has no object") {
  const int local = 0;
  CHECK(loaded_object_at(&local) == nullptr);
  CHECK(loaded_object_at(nullptr) == nullptr);
}

TEST_CASE("the objects that are loaded can be listed") {
  const auto before = loaded_objects();
  CHECK(before.contains(loaded_object_at(&variable)));
  CHECK(before.contains(loaded_object_at(::dlsym(RTLD_DEFAULT, "gnu_get_libc_version"))));
  CHECK(!before.contains(nullptr));
  void* const library = ::dlopen("libresolv.so.2", RTLD_NOW | RTLD_LOCAL);
  REQUIRE(library != nullptr);
  const link_map* const added = loaded_object_at(::dlsym(library, "ns_sprintrr"));
  CHECK(!before.contains(added));
  CHECK(loaded_objects().contains(added));
  ::dlclose(library);
  CHECK(loaded_objects() == before);
}
