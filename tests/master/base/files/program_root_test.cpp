#include "master/base/files/program_root.h"

#include <filesystem>

#include <catch2/catch.hpp>

TEST_CASE("the root of a program is the folder above its own") {
  const std::filesystem::path root = stride::core::program_root();
  const std::filesystem::path folder = std::filesystem::canonical("/proc/self/exe").parent_path();
  CHECK(root == folder.parent_path());
  CHECK(std::filesystem::is_directory(root));
}
