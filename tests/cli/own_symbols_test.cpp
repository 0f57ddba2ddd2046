// Units whose functions have names that the program and its libraries have, too.
#include <array>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <utility>

#include "tests/build.h"
#include "tests/cli/scenarios.h"

using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// CRC-32C of "123456789", by the unit's function that has the name of zlib's.
constexpr double kChecksum = 3808858755;

/// The last row's.
double last(const Workspace& workspace, const std::string& name) {
  return workspace.signals().numbers("unit." + name).back();
}

void check_all_own(const Workspace& workspace, const Outcome& outcome) {
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(last(workspace, "called") >= 1);
  CHECK(last(workspace, "own") == last(workspace, "called"));
}

/// The allocator is another one than the C library's, as with LD_PRELOAD and libjemalloc.
class OtherAllocator {
 public:
  OtherAllocator() { ::setenv("LD_PRELOAD", raw_library("libstride_test_allocator").c_str(), 1); }
  ~OtherAllocator() { ::unsetenv("LD_PRELOAD"); }
  OtherAllocator(const OtherAllocator&) = delete;
  OtherAllocator& operator=(const OtherAllocator&) = delete;
};

}  // namespace

TEST_CASE("a unit calls its own functions, whatever names others in the process have") {
  if (kSanitized) return;  // whose functions come before all others
  const std::string unit =
      GENERATE("own_checksum", "own_names", "own_names_static", "every_symbol");
  const Arguments hosting =
      GENERATE(Arguments{}, Arguments{"--isolate"},
               Arguments{"--at", "unit=exec:exec " + stride_program().string() + " serve"});
  CAPTURE(unit, hosting);
  const Workspace workspace(Parts{component("unit", unit + ".fmu")});
  Arguments arguments{"--quiet"};
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  check_all_own(workspace, workspace.run(arguments));
  if (unit == "own_checksum") CHECK(last(workspace, "value") == kChecksum);
  if (unit == "every_symbol") CHECK(last(workspace, "called") > 1000);
}

TEST_CASE("units that bring along libraries of one name have their own ones") {
  if (kSanitized) return;  // whose functions come before all others
  const Arguments hosting =
      GENERATE(Arguments{}, Arguments{"--isolate"}, Arguments{"--isolate=b3"});
  const std::array order = GENERATE(std::array{1, 2, 3, 4, 3}, std::array{4, 3, 2, 1, 2});
  std::string components;
  for (std::size_t i = 0; i < order.size(); ++i) {
    components +=
        component("b" + std::to_string(i), "bundling_" + std::to_string(order[i]) + ".fmu");
  }
  const Workspace workspace(Parts{components});
  fs::copy_file(test_fmu("bundling_3"), workspace / "bundling_3.fmu");  // another file
  Arguments arguments{"--quiet"};
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(workspace.left_behind().empty());
  const Csv signals = workspace.signals();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string name = "b" + std::to_string(i);
    CAPTURE(name, order[i]);
    CHECK(signals.numbers(name + ".value").back() == order[i]);
    CHECK(signals.numbers(name + ".own").back() == signals.numbers(name + ".called").back());
  }
}

TEST_CASE("units have their own ones of what a process has once") {
  if (kSanitized) return;
  const Arguments hosting = GENERATE(Arguments{}, Arguments{"--isolate"}, Arguments{"--isolate=b"});
  const auto order = GENERATE(std::array{1, 2, 1}, std::array{2, 1, 2});
  const std::string unit = "only_one_";
  const Workspace workspace(Parts{component("a", unit + std::to_string(order[0]) + ".fmu") +
                                  component("b", unit + std::to_string(order[1]) + ".fmu") +
                                  component("c", unit + std::to_string(order[2]) + ".fmu")});
  Arguments arguments{"--quiet"};
  arguments.insert(arguments.end(), hosting.begin(), hosting.end());
  const Outcome outcome = workspace.run(arguments);
  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.err == "");
  CHECK(workspace.left_behind().empty());
  const Csv signals = workspace.signals();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    CHECK(signals.numbers(name + ".value").back() == order[i]);
    CHECK(signals.numbers(name + ".own").back() == 2);
  }
}

TEST_CASE("verify leaves nothing of a unit that brings a library of stride's along") {
  const Workspace workspace(Parts{component("unit", "own_checksum.fmu")});
  const fs::path binaries = workspace / "unit/binaries" / stride::importer::fmi2_platform();
  fs::create_directories(binaries);
  const fs::path built = build_folder() / "tests/test_units/bundling_3";
  fs::copy_file(built / "modelDescription.xml", workspace / "unit/modelDescription.xml");
  const fs::path from = built / "binaries" / stride::importer::fmi2_platform();
  std::string unit = read(from / "bundling_3.so");
  const std::string before = "libstride_test_shared.so";
  std::string name = "libz.so.1";
  fs::copy_file(from / before, binaries / name);
  name.resize(before.size(), '\0');
  workspace.scratch().write(
      "unit/binaries/" + std::string(stride::importer::fmi2_platform()) + "/bundling_3.so",
      unit.replace(unit.find(before), before.size(), name));
  CHECK(workspace.stride({"verify", "unit", "--check", "load"}).exit_code == 0);
  CHECK(workspace.left_behind().empty());
}

TEST_CASE("where another allocator is in the process, a unit cannot have its own, with a warning") {
  if (kSanitized) return;
  const OtherAllocator allocator;
  const Workspace workspace(Parts{component("unit", "own_checksum.fmu")});
  const Outcome outcome = workspace.run({"--quiet"});
  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.err,
             Contains("unit 'unit': the unit has symbols of its own that are replaced") &&
                 Contains("'crc32' (libz.so.1)") && Contains("malloc"));
  CHECK(last(workspace, "own") == 0);
}

TEST_CASE("a unit that stride has built calls its own functions with any allocator") {
  const std::string sources = fs::path(STRIDE_SOURCE_DIR).string();
  const Workspace workspace(Parts{component("unit", "built.fmu")});
  fs::create_directories(workspace / "source/sources");
  const fs::path test_units = fs::path(STRIDE_SOURCE_DIR) / "tests/test_units";
  fs::copy_file(test_units / "fmi2/own_symbols.c", workspace / "source/sources/own_symbols.c");
  fs::copy_file(test_units / "own_symbols/checksum.c", workspace / "source/sources/checksum.c");
  std::string description = read(test_units / "fmi2/own_symbols.xml");
  for (const auto& [from, to] : {std::pair("@NAME@", "built"), {"@HAS_STATE@", "true"}}) {
    for (std::size_t at = 0; (at = description.find(from, at)) != description.npos;) {
      description.replace(at, std::strlen(from), to);
    }
  }
  const std::string files =
      "><SourceFiles><File name=\"own_symbols.c\"/><File name=\"checksum.c\"/></SourceFiles>"
      "</CoSimulation>";
  const std::size_t end = description.find("/>");
  description.replace(end, 2, files);
  workspace.scratch().write("source/modelDescription.xml", description);
  const Outcome built = workspace.stride({"build", "source", "-o", "built.fmu", "-I", sources, "-I",
                                          sources + "/interfaces", "-D", "UNIT_NAME=\"built\""});
  INFO(built.err);
  REQUIRE(built.exit_code == 0);
  std::optional<OtherAllocator> allocator;
  if (!kSanitized) allocator.emplace();
  check_all_own(workspace, workspace.run({"--quiet"}));
  CHECK(last(workspace, "value") == kChecksum);
}
