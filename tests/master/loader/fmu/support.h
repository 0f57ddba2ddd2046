// What the tests of master/loader/fmu share: the units made for tests.
#ifndef STRIDE_TESTS_MASTER_LOADER_FMU_SUPPORT_H
#define STRIDE_TESTS_MASTER_LOADER_FMU_SUPPORT_H

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "master/loader/fmu/description/binaries.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/process/hosted_unit.h"
#include "tests/build.h"
#include "tests/master/base/archive/support.h"
#include "tests/master/engine/run/unit_capabilities.h"

namespace stride::tests {

inline fs::path test_fmu(const std::string& name) { return test_unit_folder() / (name + ".fmu"); }
inline fs::path raw_library(const std::string& name) {
  return test_unit_folder() / "raw" / (name + ".so");
}

inline fs::path fmi2_library(const std::string& unit) {
  const char* const platform = importer::fmi2_platform();
  return build_folder() / "tests/test_units" / unit / "binaries" / platform / (unit + ".so");
}

/// Whether units are to live in processes of their own: the tests of instances run in both ways,
/// but for those that look into the memory of a unit's library, which have the tag [here].
inline bool is_hosted() { return std::getenv("STRIDE_TEST_HOSTED") != nullptr; }

inline std::unique_ptr<core::Unit> make_unit(const std::shared_ptr<importer::Fmu>& fmu,
                                             const std::string& name,
                                             importer::InstanceOptions options = {}) {
  if (is_hosted()) return isolation::instantiate(fmu, name, std::move(options), {});
  return fmu->instantiate(name, std::move(options));
}

/// A model description around these attributes of <CoSimulation> and these variables.
inline std::string description_text(const std::string& identifier,
                                    const std::string& flags = "hasEventMode=\"true\"",
                                    const std::string& variables = "") {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="test" instantiationToken="token">
<CoSimulation modelIdentifier=")" +
         identifier + "\" " + flags + "/>\n<ModelVariables>\n" + variables +
         "<Float64 name=\"time\" valueReference=\"0\" causality=\"independent\"/>\n"
         "</ModelVariables>\n<ModelStructure/>\n</fmiModelDescription>\n";
}

/// An FMU folder around one of the raw libraries.
inline fs::path make_raw_fmu(const Scratch& scratch, const std::string& library,
                             const std::string& flags = "hasEventMode=\"true\"") {
  const fs::path folder = scratch / library;
  const fs::path binaries = folder / "binaries" / importer::platform();
  fs::create_directories(binaries);
  fs::copy_file(raw_library(library), binaries / (library + ".so"));
  scratch.write(library + "/modelDescription.xml", description_text(library, flags));
  return folder;
}

}  // namespace stride::tests

#endif
