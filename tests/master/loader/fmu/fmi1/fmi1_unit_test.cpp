#include "master/loader/fmu/fmi1/fmi1_unit.h"

#include <algorithm>
#include <cmath>

#include <dlfcn.h>

#include "master/loader/fmu/description/model_description.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/fmu/library/unpacked_fmu.h"
#include "tests/at.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using namespace std::chrono_literals;
using Catch::Matchers::Contains;
using core::ValueBlock;
using core::ValueReference;
using core::ValueType;

namespace {

/// An instance of the tank, and what it logs.
class Tank {
 public:
  explicit Tank(const std::string& fmu = "fmi1_tank") : fmu_(importer::Fmu::load(test_fmu(fmu))) {
    importer::InstanceOptions options;
    options.log = [this](const std::string&, importer::Status, const std::string&,
                         const std::string& message) { messages.push_back(message); };
    unit_ = make_unit(fmu_, "tank", std::move(options));
  }

  core::Unit* operator->() { return unit_.get(); }
  const core::UnitDescription& description() const { return *fmu_->description(); }

  template <class T>
  void set(ValueType type, const std::string& name, T value) {
    ValueBlock block(type, 1);
    block.numbers<T>()[0] = value;
    set(name, block);
  }
  void set(const std::string& name, const ValueBlock& block) {
    const ValueReference r = *description().find(name);
    unit_->set({&r, 1}, block);
  }
  ValueBlock get(ValueType type, const std::string& name) {
    const ValueReference r = *description().find(name);
    ValueBlock block(type, 1);
    unit_->get({&r, 1}, block);
    return block;
  }
  double level() { return get(ValueType::Float64, "level").numbers<double>()[0]; }

  Tank& start(int mood = 0) {
    set<std::int32_t>(ValueType::Int32, "mood", mood);
    unit_->enter_initialization({}, Time(2s));
    unit_->exit_initialization();
    return *this;
  }

  template <class T>
  const T* global(const char* name) const {
    void* const library = ::dlopen(fmu_->load_library()->path().c_str(), RTLD_NOW | RTLD_NOLOAD);
    REQUIRE(library != nullptr);
    void* const address = ::dlsym(library, name);
    ::dlclose(library);
    REQUIRE(address != nullptr);
    return static_cast<const T*>(address);
  }
  void free() { unit_.reset(); }

  std::vector<std::string> messages;

 private:
  std::shared_ptr<importer::Fmu> fmu_;
  std::unique_ptr<core::Unit> unit_;
};

}  // namespace

TEST_CASE("the description of an FMI 1.0 unit has causalities and types as those of later ones") {
  const Tank tank;
  const core::UnitDescription& description = tank.description();
  CHECK(description.fmi_version == "1.0");
  CHECK(description.can_vary_step);
  CHECK(description.may_reject);
  CHECK_FALSE(description.can_save_state);
  CHECK(description.default_stop == Time(2s));
  const auto variable = [&](const char* name) {
    return description.variables.at(description.find(name).value());
  };
  CHECK(variable("inflow").causality == core::Causality::Input);
  CHECK(variable("inflow").variability == core::Variability::Continuous);
  CHECK(variable("level").causality == core::Causality::Output);
  CHECK(variable("level").unit == "m");
  CHECK(variable("level").min == "0");
  CHECK(variable("longest").causality == core::Causality::Parameter);
  CHECK(variable("longest").initial == core::Initial::Exact);
  CHECK(variable("mood").variability == core::Variability::Fixed);
  CHECK(variable("mode").items ==
        std::vector<std::pair<std::string, std::int64_t>>{{"open", 1}, {"closed", 2}});
  CHECK_FALSE(description.find("label.negated"));
  REQUIRE(description.warnings.size() == 1);
  CHECK_THAT(description.warnings[0],
             Contains("'label.negated' is left out: no String can be a negatedAlias"));
  REQUIRE(description.outputs.size() == 4);
  CHECK(description.outputs[0].dependencies == std::vector<ValueReference>{});
  CHECK(description.outputs[1].dependencies ==
        std::vector{static_cast<ValueReference>(*description.find("mode"))});
  CHECK(description.outputs[2].dependencies == std::nullopt);
}

TEST_CASE("the interface type of an FMI 1.0 unit, as it is written, and words in another case") {
  std::string text = read(importer::UnpackedFmu(test_fmu("fmi1_tank")).description());
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    for (std::size_t at = 0; (at = changed.find(from, at)) != std::string::npos; at += to.size()) {
      changed.replace(at, from.size(), to);
    }
    return importer::parse_model_description(changed, "unit.xml");
  };
  const auto warned = [](const core::UnitDescription& unit, const std::string& warning) {
    return std::ranges::any_of(unit.warnings, [&](const std::string& text) {
      return text.find(warning) != std::string::npos;
    });
  };
  CHECK(warned(with("CoSimulation_StandAlone", "CoSimulation_Standalone"),
               "<CoSimulation_Standalone> is taken for <CoSimulation_StandAlone>"));
  CHECK_THAT(input_error([&] { with("CoSimulation_StandAlone", "CoSimulation_Tool"); }),
             Contains("the unit couples stride to a tool"));
  CHECK_THAT(input_error([&] { with("CoSimulation_StandAlone", "Simulation"); }),
             Contains("<Implementation> has no <CoSimulation_StandAlone>"));
  const auto unit = with("causality=\"output\"", "causality=\"Output\"");
  CHECK(warned(unit, "causality=\"Output\" of <ScalarVariable> is taken for output"));
  CHECK(unit.variables[*unit.find("level")].causality == core::Causality::Output);
}

TEST_CASE("an FMI 1.0 unit goes through its life cycle", "[here]") {
  Tank tank;
  CHECK(*tank.global<int>("fmi1_living_units") == 1);
  CHECK_THAT(tank.global<char>("fmi1_location"), Contains("file:///"));
  tank.set<double>(ValueType::Float64, "inflow", 3);
  tank.start();
  CHECK(*tank.global<double>("fmi1_stop") == 2);
  CHECK(tank->step({{}, at(0.5)}).reached == at(0.5));
  CHECK(*tank.global<int>("fmi1_new_step") == 1);
  CHECK(tank.level() == 1.5);
  CHECK_NOTHROW(tank->terminate());
  const int* const living = tank.global<int>("fmi1_living_units");
  tank.free();
  CHECK(*living == 0);
}

TEST_CASE("values of all types of FMI 1.0 go in and out") {
  Tank tank;
  tank.start();
  ValueBlock text(ValueType::String, 1);
  text.strings()[0] = "grüß Gott";
  tank.set("label", text);
  tank.set<std::int64_t>(ValueType::Enumeration, "mode", 2);
  tank.set<bool>(ValueType::Boolean, "is_on", true);
  CHECK(tank.get(ValueType::String, "label.echo") == text);
  CHECK(tank.get(ValueType::Enumeration, "mode.echo").numbers<std::int64_t>()[0] == 2);
  CHECK(tank.get(ValueType::Boolean, "is_on.echo").numbers<bool>()[0]);
  CHECK_THAT(run_error([&] {
               tank.set<std::int64_t>(ValueType::Enumeration, "mode", std::int64_t{1} << 40);
             }),
             Contains("does not fit into an Enumeration of FMI 1.0"));
}

TEST_CASE("a negated alias of FMI 1.0 has the negative value, in both directions") {
  Tank tank;
  tank.set<double>(ValueType::Float64, "limit", -0.125);
  tank.set<bool>(ValueType::Boolean, "is_on", true);
  tank.start(3);
  CHECK_FALSE(std::signbit(tank.get(ValueType::Float64, "drop").numbers<double>()[0]));
  CHECK(tank.get(ValueType::Float64, "longest").numbers<double>()[0] == 0.125);
  CHECK(tank->step({{}, at(0.5)}).reached == at(0.125));
  CHECK(tank.level() == 0.125);
  CHECK(tank.get(ValueType::Float64, "drop").numbers<double>()[0] == -0.125);
  CHECK(tank.get(ValueType::Int32, "temper").numbers<std::int32_t>()[0] == -3);
  CHECK_FALSE(tank.get(ValueType::Boolean, "is_off").numbers<bool>()[0]);
}

TEST_CASE("a step that an FMI 1.0 unit refuses is rejected, and repeated as such", "[here]") {
  Tank tank;
  tank.start(2);
  CHECK(tank->step({{}, at(0.5)}).rejected);
  CHECK(*tank.global<int>("fmi1_new_step") == 1);
  CHECK(tank->step({{}, at(0.25)}).reached == at(0.25));
  CHECK(*tank.global<int>("fmi1_new_step") == 0);
  CHECK(tank->step({at(0.25), at(0.5)}).reached == at(0.5));
  CHECK(*tank.global<int>("fmi1_new_step") == 1);
  CHECK(tank.level() == 0.5);
}

TEST_CASE("a step that an FMI 1.0 unit completes in part is an early return") {
  Tank tank;
  tank.start(3);
  const core::StepResult result = tank->step({{}, at(0.5)});
  CHECK(result.early_return);
  CHECK(result.reached == at(0.25));
  CHECK(tank.level() == 0.25);
}

TEST_CASE("what an FMI 1.0 unit says of a step that it cannot repeat is in the error") {
  const auto error = [](int mood) {
    Tank tank("fmi1_hasty_tank");
    tank.start(mood);
    return run_error([&] { tank->step({{}, at(0.5)}); });
  };
  CHECK_THAT(error(2), Contains("it came no further than where the step began") &&
                           Contains("cannot repeat a step (canRejectSteps)"));
  CHECK_THAT(error(6), Contains("it came to -1 s, which is not in the step"));
}

TEST_CASE("messages and failures of an FMI 1.0 unit") {
  Tank warns;
  warns.start(1);
  CHECK(warns->step({{}, at(0.5)}).reached == at(0.5));
  CHECK(warns.messages == std::vector<std::string>{"level gets hot"});
  Tank leaks;
  leaks.start(4);
  CHECK_THAT(run_error([&] {
               leaks->step({{}, at(0.5)});
             }),
             Contains("unit 'tank', at 0 s: fmiDoStep returned fmiError: it leaks"));
  Tank pends;
  pends.start(5);
  CHECK_THAT(run_error([&] { pends->step({{}, at(0.5)}); }), Contains("fmiPending"));
}

TEST_CASE("an FMI 1.0 unit that is reset is as new") {
  Tank tank;
  tank.start();
  tank->step({{}, at(0.5)});
  resetting(*tank.operator->()).reset();
  tank.start();
  CHECK(tank.level() == 0);
  CHECK(tank->step({{}, at(0.25)}).reached == at(0.25));
  CHECK(tank.level() == 0.25);
}

TEST_CASE("functions of FMI 1.0 are named by the library, if its description differs") {
  const Scratch scratch;
  fs::copy(importer::UnpackedFmu(test_fmu("fmi1_tank")).folder(), scratch / "unit",
           fs::copy_options::recursive);
  std::string text = read(scratch / "unit/modelDescription.xml");
  const std::string own = "modelIdentifier=\"fmi1_tank\"";
  REQUIRE(text.find(own) != text.npos);
  text.replace(text.find(own), own.size(), "modelIdentifier=\"FMI1_Tank\"");
  scratch.write("unit/modelDescription.xml", text);
  std::vector<std::string> messages;
  importer::InstanceOptions options;
  options.log = [&](const auto&, auto, const auto&, const auto& text) { messages.push_back(text); };
  CHECK(make_unit(importer::Fmu::load(scratch / "unit"), "tank", std::move(options)) != nullptr);
  REQUIRE(messages.size() == 1);
  CHECK_THAT(messages[0], Contains("its library is") && Contains("expected"));
}
