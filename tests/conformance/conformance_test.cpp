// One suite for every unit: what FMI 3.0 promises an importer, checked at the C ABI. The unit is
// named by the environment variable STRIDE_FMU.
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "master/engine/model/values.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/fmu/library/fmi3_library.h"

namespace {

using namespace stride;
using core::Causality;
using core::ValueType;

constexpr double kStep = 1e-3;

/// The unit under test, unpacked and loaded once.
struct TestedFmu {
  std::shared_ptr<importer::Fmu> fmu;
  std::shared_ptr<const importer::Fmi3Library> library;
  std::string resources;

  TestedFmu() {
    const char* const path = std::getenv("STRIDE_FMU");
    if (path == nullptr) throw std::runtime_error("name the unit in STRIDE_FMU");
    fmu = importer::Fmu::load(path);
    library = fmu->load_fmi3_library();
    const auto root = library->path().parent_path().parent_path().parent_path();
    resources = importer::resource_path(root / "resources");
  }
  const importer::Fmi3Functions& call() const { return library->functions(); }
  const core::UnitDescription& description() const { return *fmu->description(); }
};

const TestedFmu& tested_fmu() {
  static const TestedFmu tested_fmu;
  return tested_fmu;
}

/// An instance that goes through its life cycle by plain FMI calls.
class Instance {
 public:
  explicit Instance(const std::string& token = tested_fmu().description().instantiation_token)
      : handle_(tested_fmu().call().InstantiateCoSimulation(
            "unit", token.c_str(),
            tested_fmu().resources.empty() ? nullptr : tested_fmu().resources.c_str(), false, false,
            tested_fmu().description().has_event_mode, false, nullptr, 0, nullptr, nullptr,
            nullptr)) {}
  ~Instance() { tested_fmu().call().FreeInstance(handle_); }
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  fmi3Instance handle() const { return handle_; }

  void start() {
    REQUIRE(call().EnterInitializationMode(handle_, false, 0, 0, false, 0) == fmi3OK);
    REQUIRE(call().ExitInitializationMode(handle_) == fmi3OK);
    time_ = 0;
    if (tested_fmu().description().has_event_mode) handle_events();
  }

  void step(int count) {
    for (int i = 0; i < count; ++i) {
      bool event = false;
      bool terminate = false;
      bool early = false;
      double reached = 0;
      const double point = kStep * time_;
      ++time_;
      REQUIRE(call().DoStep(handle_, point, kStep * time_ - point, false, &event, &terminate,
                            &early, &reached) == fmi3OK);
      REQUIRE_FALSE(early);
      REQUIRE(reached == Approx(kStep * time_));
      if (!event) continue;
      REQUIRE(call().EnterEventMode(handle_) == fmi3OK);
      handle_events();
    }
  }

  /// Its time, for an instance whose state was restored.
  void continue_at(int time) { time_ = time; }

  /// The texts of all variables that can be read in Step Mode.
  std::vector<std::string> values() const {
    std::vector<std::string> texts;
    for (const core::Variable& variable : tested_fmu().description().variables) {
      if (variable.type == ValueType::Clock || variable.is_clocked()) continue;
      texts.push_back(variable.name + "=" + value(variable));
    }
    return texts;
  }

 private:
  static const importer::Fmi3Functions& call() { return tested_fmu().call(); }

  void handle_events() {
    bool again = true;
    for (int i = 0; again; ++i) {
      REQUIRE(i < 100);
      bool terminate = false;
      bool nominals = false;
      bool states = false;
      bool defined = false;
      double next = 0;
      REQUIRE(call().UpdateDiscreteStates(handle_, &again, &terminate, &nominals, &states, &defined,
                                          &next) == fmi3OK);
    }
    REQUIRE(call().EnterStepMode(handle_) == fmi3OK);
  }

  std::string value(const core::Variable& variable) const {
    core::ValueBlock block(variable.type, variable.size);
    read(variable, block);
    return core::elements_text(block);
  }

  template <class Get, class T>
  void read_numbers(Get* get, const core::Variable& variable, std::span<T> values) const {
    REQUIRE(get(handle_, &variable.reference, 1, values.data(), values.size()) == fmi3OK);
  }

  void read(const core::Variable& variable, core::ValueBlock& block) const {
    const auto& fmi = call();
    switch (variable.type) {
      case ValueType::Float32:
        return read_numbers(fmi.GetFloat32, variable, block.numbers<float>());
      case ValueType::Float64:
        return read_numbers(fmi.GetFloat64, variable, block.numbers<double>());
      case ValueType::Int8:
        return read_numbers(fmi.GetInt8, variable, block.numbers<std::int8_t>());
      case ValueType::UInt8:
        return read_numbers(fmi.GetUInt8, variable, block.numbers<std::uint8_t>());
      case ValueType::Int16:
        return read_numbers(fmi.GetInt16, variable, block.numbers<std::int16_t>());
      case ValueType::UInt16:
        return read_numbers(fmi.GetUInt16, variable, block.numbers<std::uint16_t>());
      case ValueType::Int32:
        return read_numbers(fmi.GetInt32, variable, block.numbers<std::int32_t>());
      case ValueType::UInt32:
        return read_numbers(fmi.GetUInt32, variable, block.numbers<std::uint32_t>());
      case ValueType::Int64:
      case ValueType::Enumeration:
        return read_numbers(fmi.GetInt64, variable, block.numbers<std::int64_t>());
      case ValueType::UInt64:
        return read_numbers(fmi.GetUInt64, variable, block.numbers<std::uint64_t>());
      case ValueType::Boolean:
        return read_numbers(fmi.GetBoolean, variable, block.numbers<bool>());
      default:
        return;  // texts and bytes are compared by the tests of the types
    }
  }

  fmi3Instance handle_;
  int time_ = 0;
};

std::vector<std::string> values_after(int steps) {
  Instance unit;
  REQUIRE(unit.handle() != nullptr);
  unit.start();
  unit.step(steps);
  return unit.values();
}

}  // namespace

TEST_CASE("the version of the interface is FMI 3.0") {
  CHECK(std::string(tested_fmu().call().GetVersion()) == "3.0");
}

TEST_CASE("a wrong token is refused") { CHECK(Instance("wrong").handle() == nullptr); }

TEST_CASE("twenty instances, one after the other, give the same results") {
  const auto first = values_after(5);
  for (int i = 1; i < 20; ++i) CHECK(values_after(5) == first);
}

TEST_CASE("two instances side by side do not disturb each other") {
  if (tested_fmu().description().single_instance) return;
  const auto alone = values_after(20);
  Instance one;
  Instance other;
  one.start();
  other.start();
  other.step(3);
  for (int i = 0; i < 20; ++i) {
    one.step(1);
    other.step(2);
  }
  CHECK(one.values() == alone);
}

TEST_CASE("after a reset an instance gives the same results as a new one") {
  Instance unit;
  unit.start();
  unit.step(17);
  REQUIRE(tested_fmu().call().Reset(unit.handle()) == fmi3OK);
  unit.start();
  unit.step(20);
  CHECK(unit.values() == values_after(20));
}

TEST_CASE("calls out of order are refused and change nothing") {
  const auto& fmi = tested_fmu().call();
  Instance unit;
  bool flag = false;
  double reached = 0;
  CHECK(fmi.DoStep(unit.handle(), 0, kStep, false, &flag, &flag, &flag, &reached) == fmi3Error);
  CHECK(fmi.ExitInitializationMode(unit.handle()) == fmi3Error);
  CHECK(fmi.EnterEventMode(unit.handle()) == fmi3Error);
  unit.start();
  CHECK(fmi.EnterInitializationMode(unit.handle(), false, 0, 0, false, 0) == fmi3Error);
  CHECK(fmi.EnterStepMode(unit.handle()) == fmi3Error);
  CHECK(fmi.DoStep(unit.handle(), 7, kStep, false, &flag, &flag, &flag, &reached) == fmi3Error);
  CHECK(fmi.DoStep(unit.handle(), 0, -kStep, false, &flag, &flag, &flag, &reached) == fmi3Error);
  unit.step(20);
  CHECK(unit.values() == values_after(20));
}

TEST_CASE("Model Exchange and Scheduled Execution are refused") {
  const auto& fmi = tested_fmu().call();
  const char* const token = tested_fmu().description().instantiation_token.c_str();
  if (fmi.InstantiateModelExchange != nullptr) {
    CHECK(fmi.InstantiateModelExchange("unit", token, nullptr, false, false, nullptr, nullptr) ==
          nullptr);
  }
  if (fmi.InstantiateScheduledExecution != nullptr) {
    CHECK(fmi.InstantiateScheduledExecution("unit", token, nullptr, false, false, nullptr, nullptr,
                                            nullptr, nullptr, nullptr) == nullptr);
  }
}

TEST_CASE("a restored state is really restored") {
  const auto& fmi = tested_fmu().call();
  Instance unit;
  unit.start();
  unit.step(10);
  fmi3FMUState state = nullptr;
  if (!tested_fmu().description().can_save_state) {
    CHECK(fmi.GetFMUState(unit.handle(), &state) == fmi3Error);
    return;
  }
  REQUIRE(fmi.GetFMUState(unit.handle(), &state) == fmi3OK);
  const auto saved = unit.values();
  unit.step(25);
  const auto later = unit.values();
  REQUIRE(fmi.SetFMUState(unit.handle(), state) == fmi3OK);
  unit.continue_at(10);
  CHECK(unit.values() == saved);
  unit.step(25);
  CHECK(unit.values() == later);
  REQUIRE(fmi.FreeFMUState(unit.handle(), &state) == fmi3OK);
  CHECK(state == nullptr);
}

TEST_CASE("a serialised state continues in another instance") {
  if (!tested_fmu().description().can_serialize_state) return;
  const auto& fmi = tested_fmu().call();
  Instance unit;
  unit.start();
  unit.step(10);
  fmi3FMUState state = nullptr;
  std::size_t size = 0;
  REQUIRE(fmi.GetFMUState(unit.handle(), &state) == fmi3OK);
  REQUIRE(fmi.SerializedFMUStateSize(unit.handle(), state, &size) == fmi3OK);
  std::vector<fmi3Byte> bytes(size);
  REQUIRE(fmi.SerializeFMUState(unit.handle(), state, bytes.data(), size) == fmi3OK);
  REQUIRE(fmi.FreeFMUState(unit.handle(), &state) == fmi3OK);
  unit.step(25);

  const bool is_initialized = GENERATE(true, false);
  Instance other;
  if (is_initialized) other.start();
  fmi3FMUState copy = nullptr;
  REQUIRE(fmi.DeserializeFMUState(other.handle(), bytes.data(), size, &copy) == fmi3OK);
  REQUIRE(fmi.SetFMUState(other.handle(), copy) == fmi3OK);
  REQUIRE(fmi.FreeFMUState(other.handle(), &copy) == fmi3OK);
  other.continue_at(10);
  other.step(25);
  CHECK(other.values() == unit.values());
}

TEST_CASE("a serialised state of which a byte is another is refused") {
  if (!tested_fmu().description().can_serialize_state) return;
  const auto& fmi = tested_fmu().call();
  Instance unit;
  unit.start();
  unit.step(10);
  fmi3FMUState state = nullptr;
  std::size_t size = 0;
  REQUIRE(fmi.GetFMUState(unit.handle(), &state) == fmi3OK);
  REQUIRE(fmi.SerializedFMUStateSize(unit.handle(), state, &size) == fmi3OK);
  std::vector<fmi3Byte> bytes(size);
  REQUIRE(fmi.SerializeFMUState(unit.handle(), state, bytes.data(), size) == fmi3OK);
  for (std::size_t i = 0; i < size; ++i) {
    std::vector<fmi3Byte> damaged = bytes;
    damaged[i] ^= 0x10;
    REQUIRE(fmi.DeserializeFMUState(unit.handle(), damaged.data(), size, &state) == fmi3Error);
  }
  REQUIRE(fmi.SetFMUState(unit.handle(), state) == fmi3OK);  // which is as it was
  const auto values = unit.values();
  unit.step(25);
  REQUIRE(fmi.SetFMUState(unit.handle(), state) == fmi3OK);
  CHECK(unit.values() == values);
  REQUIRE(fmi.FreeFMUState(unit.handle(), &state) == fmi3OK);
}
