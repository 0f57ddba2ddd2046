// A system of FMUs and scripted units, and a run of it.
#ifndef STRIDE_TESTS_PHYSICS_FMU_SYSTEM_H
#define STRIDE_TESTS_PHYSICS_FMU_SYSTEM_H

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "master/engine/run/simulation.h"
#include "master/loader/fmu/fmu.h"
#include "tests/build.h"
#include "tests/master/engine/run/scripted_unit.h"

namespace stride::tests {

/// The recorded values by name, one for each communication point.
struct Record : core::Observer {
  std::vector<std::string> names;
  std::vector<double> times;
  std::map<std::string, std::vector<double>> values;

  void on_start(std::span<const core::Signal> signals) override {
    signals_.assign(signals.begin(), signals.end());
  }
  void on_communication_point(Time time) override {
    times.push_back(to_seconds(time));
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      const core::ValueBlock& block = *signals_[i].block;
      const bool real = block.type() == core::ValueType::Float64;
      values[names[i]].push_back(real ? block.numbers<double>()[signals_[i].first]
                                      : block.numbers<std::int32_t>()[signals_[i].first]);
    }
  }

 private:
  std::vector<core::Signal> signals_;
};

class FmuSystem {
 public:
  void add(const std::string& name, const std::filesystem::path& fmu,
           const std::map<std::string, std::string>& start_values = {}) {
    const auto loaded = importer::Fmu::load(fmu);
    declaration_.components.push_back({name, loaded->description(), {}, {}});
    units_.push_back(loaded->instantiate(name));
    for (const auto& [variable, value] : start_values) {
      declaration_.start_values.push_back({name, variable, value, "", {}});
    }
  }
  core::ScriptedUnit& add(const std::string& name,
                          std::shared_ptr<const core::UnitDescription> description) {
    declaration_.components.push_back({name, description, {}, {}});
    auto unit = std::make_unique<core::ScriptedUnit>(description);
    core::ScriptedUnit& added = *unit;
    units_.push_back(std::move(unit));
    return added;
  }
  void wire(const std::string& from, const std::string& output, const std::string& to,
            const std::string& input) {
    declaration_.connections.push_back({from, output, to, input, false, {}});
  }
  /// Runs to `stop` and records the variables, written "component.variable".
  Record run(Duration stop, Duration step, std::vector<std::string> recorded) {
    const core::System system(declaration_);
    core::RunOptions options;
    options.stop = Time(stop);
    options.step.size = step;
    for (const std::string& name : recorded) options.recorded.push_back(find(system, name));
    core::Simulation simulation(system, std::move(units_), options);
    Record record;
    record.names = std::move(recorded);
    simulation.add_observer(record);
    simulation.run();
    return record;
  }

 private:
  static core::VariableId find(const core::System& system, const std::string& name) {
    for (std::size_t i = 0; i < system.components().size(); ++i) {
      const auto& component = system.components()[i];
      if (!name.starts_with(component.name + ".")) continue;
      const auto place = component.description->find(name.substr(component.name.size() + 1));
      if (place) return {i, *place};
    }
    throw std::invalid_argument(name);
  }

  core::SystemDeclaration declaration_;
  std::vector<std::unique_ptr<core::Unit>> units_;
};

inline std::filesystem::path fmu(const std::string& name) {
  return unit_folder() / (name + ".fmu");
}
inline std::filesystem::path test_fmu(const std::string& name) {
  return test_unit_folder() / (name + ".fmu");
}

}  // namespace stride::tests

#endif
