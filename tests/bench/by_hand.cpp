// by_hand LIBRARY TOKEN INPUT OUTPUT UNITS STEPS SIZE [PARAMETER=VALUE]: the loop that a user of
// FMI 3.0 would write for a ring of units, each fed by its neighbour: fmi3DoStep of all,
// fmi3GetFloat64 of all, fmi3SetFloat64 of all, unless INPUT is "none". Prints the nanoseconds of a
// unit step.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <dlfcn.h>

#include <stride/fmi3.h>

namespace {

/// Whether to call a function is not decided anew in each step, so the loop has no checks but the
/// one of the status.
void require(bool is_good, const char* what) {
  if (is_good) return;
  std::fprintf(stderr, "by_hand: %s failed\n", what);
  std::exit(1);
}

template <class Function>
Function* symbol(void* library, const char* name) {
  void* const found = ::dlsym(library, name);
  require(found != nullptr, name);
  return reinterpret_cast<Function*>(found);
}

/// "REFERENCE=VALUE"
void set_parameter(fmi3SetFloat64TYPE* set, fmi3Instance unit, const std::string& text) {
  const std::size_t sign = text.find('=');
  require(sign != std::string::npos, "reading a parameter");
  const auto reference = static_cast<fmi3ValueReference>(std::stoul(text.substr(0, sign)));
  const double value = std::stod(text.substr(sign + 1));
  require(set(unit, &reference, 1, &value, 1) == fmi3OK, "fmi3SetFloat64 of a parameter");
}

void ignore(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String) {}

}  // namespace

int main(int argc, char** argv) {
  require(argc == 8 || argc == 9, "reading the arguments");
  void* const library = ::dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  require(library != nullptr, "loading the library");
  const char* const token = argv[2];
  const bool has_input = std::string(argv[3]) != "none";
  const auto input = static_cast<fmi3ValueReference>(has_input ? std::stoul(argv[3]) : 0);
  const auto output = static_cast<fmi3ValueReference>(std::stoul(argv[4]));
  const std::size_t count = std::stoul(argv[5]);
  const std::uint64_t steps = std::stoull(argv[6]);
  const double size = std::stod(argv[7]);

  auto* const instantiate =
      symbol<fmi3InstantiateCoSimulationTYPE>(library, "fmi3InstantiateCoSimulation");
  auto* const enter =
      symbol<fmi3EnterInitializationModeTYPE>(library, "fmi3EnterInitializationMode");
  auto* const exit = symbol<fmi3ExitInitializationModeTYPE>(library, "fmi3ExitInitializationMode");
  auto* const do_step = symbol<fmi3DoStepTYPE>(library, "fmi3DoStep");
  auto* const get = symbol<fmi3GetFloat64TYPE>(library, "fmi3GetFloat64");
  auto* const set = symbol<fmi3SetFloat64TYPE>(library, "fmi3SetFloat64");
  auto* const free_instance = symbol<fmi3FreeInstanceTYPE>(library, "fmi3FreeInstance");

  std::vector<fmi3Instance> units;
  for (std::size_t i = 0; i < count; ++i) {
    units.push_back(instantiate("unit", token, nullptr, false, false, false, false, nullptr, 0,
                                nullptr, &ignore, nullptr));
    require(units.back() != nullptr, "fmi3InstantiateCoSimulation");
    if (argc == 9) set_parameter(set, units.back(), argv[8]);
    require(enter(units.back(), false, 0, 0, false, 0) == fmi3OK, "fmi3EnterInitializationMode");
    require(exit(units.back()) == fmi3OK, "fmi3ExitInitializationMode");
  }
  std::vector<double> outputs(count);
  bool is_good = true;
  const auto began = std::chrono::steady_clock::now();
  for (std::uint64_t step = 0; step < steps; ++step) {
    const double point = static_cast<double>(step) * size;
    for (const fmi3Instance unit : units) {
      bool event, terminate, early;
      double reached;
      is_good &= do_step(unit, point, size, true, &event, &terminate, &early, &reached) == fmi3OK;
    }
    for (std::size_t i = 0; i < count; ++i) {
      is_good &= get(units[i], &output, 1, &outputs[i], 1) == fmi3OK;
    }
    for (std::size_t i = 0; has_input && i < count; ++i) {
      is_good &= set(units[i + 1 == count ? 0 : i + 1], &input, 1, &outputs[i], 1) == fmi3OK;
    }
  }
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - began;
  require(is_good, "a call in a step");
  for (const fmi3Instance unit : units) free_instance(unit);
  std::printf("%.3f\n",
              elapsed.count() / (static_cast<double>(steps) * static_cast<double>(count)));
}
