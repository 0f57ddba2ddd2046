// The build that a test belongs to. Functions and a constant of another file, not macros, so that a
// test compiles to the same object in each build folder.
#ifndef STRIDE_TESTS_BUILD_H
#define STRIDE_TESTS_BUILD_H

#include <filesystem>
#include <string>

namespace stride::tests {

/// Whether the libraries under test have sanitizers: memory is not measured there, and long tests
/// are shorter.
extern const bool kSanitized;

std::filesystem::path build_folder();
/// This repository's units, as NAME.fmu.
std::filesystem::path unit_folder();
/// The units made for tests, as NAME.fmu.
std::filesystem::path test_unit_folder();
/// The shared library of one of either, by the unit's name. Throws std::runtime_error if this build
/// has none.
std::filesystem::path unit_library(const std::string& unit);
std::filesystem::path stride_program();

}  // namespace stride::tests

#endif
