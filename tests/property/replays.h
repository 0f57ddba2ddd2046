// A component of a system alone, with what it received there played to it.
#ifndef STRIDE_TESTS_PROPERTY_REPLAYS_H
#define STRIDE_TESTS_PROPERTY_REPLAYS_H

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "master/loader/fmu/description/binaries.h"
#include "master/loader/fmu/library/fmi3_library.h"
#include "tests/build.h"
#include "tests/master/base/archive/support.h"
#include "tests/property/assembly.h"

namespace stride::tests {

/// The unit player with this file, as `stride pack` makes it, but for the archive.
inline std::shared_ptr<importer::Fmu> player_of(const Scratch& scratch, const fs::path& stimuli) {
  const fs::path folder = scratch / "player";
  const fs::path binaries = folder / "binaries" / importer::platform();
  fs::create_directories(folder / "resources");
  fs::create_directories(binaries);
  fs::copy_file(stimuli, folder / "resources/stimuli.csv");
  fs::create_symlink(unit_library("player"), binaries / "player.so");
  const importer::Fmi3Library library(unit_library("player"));
  scratch.write("player/modelDescription.xml", library.describe(folder / "resources"));
  return importer::Fmu::load(folder);
}

/// The component of the system, as it is there, with a player in the place of all others.
inline Assembly alone(const Assembly& system, const std::string& component,
                      std::shared_ptr<importer::Fmu> player) {
  const core::SystemDeclaration& whole = system.declaration();
  const auto declared =
      std::ranges::find_if(whole.components, [&](const auto& c) { return c.name == component; });
  Assembly assembly;
  assembly.add("player", std::move(player)).add(component, declared->description->model_identifier);
  for (const auto& value : whole.start_values) {
    if (value.component == component) assembly.set(component + "." + value.variable, value.value);
  }
  for (const auto& wire : whole.connections) {
    if (wire.to_component != component) continue;
    assembly.wire("player." + wire.to_connector, component + "." + wire.to_connector);
  }
  return assembly;
}

}  // namespace stride::tests

#endif
