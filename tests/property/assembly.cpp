#include "tests/property/assembly.h"

#include <algorithm>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "master/base/time_text.h"
#include "master/loader/network/remote_unit.h"
#include "master/loader/process/hosted_unit.h"
#include "master/observe/recorders/csv_recorder.h"
#include "master/observe/recorders/event_recorder.h"
#include "tests/master/loader/fmu/support.h"

namespace stride::tests {
namespace {

std::pair<std::string, std::string> split(const std::string& name) {
  const std::size_t dot = name.find('.');
  return {name.substr(0, dot), name.substr(dot + 1)};
}

bool is_recorded(const core::Variable& variable) {
  return variable.causality == core::Causality::Output && variable.type != core::ValueType::Clock &&
         !variable.is_clocked();
}

std::vector<core::VariableId> all_outputs(const core::System& system) {
  std::map<std::string, std::size_t> components;
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    components.emplace(system.components()[i].name, i);
  }
  std::vector<core::VariableId> ids;
  for (const auto& [name, component] : components) {
    const auto& variables = system.components()[component].description->variables;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (is_recorded(variables[i])) ids.push_back({component, i});
    }
  }
  return ids;
}

/// Keeps the values of all scalar numbers.
class ValueRecorder : public core::Observer {
 public:
  ValueRecorder(const core::System& system, Results& results)
      : system_(system), results_(results) {}

  void on_start(std::span<const core::Signal> signals) override {
    signals_.assign(signals.begin(), signals.end());
    for (const core::Signal& signal : signals_) {
      results_.names.push_back(system_.full_name(signal.id));
    }
  }
  void on_communication_point(Time time) override {
    std::vector<double>& row = results_.values[time];
    row.clear();
    for (const core::Signal& signal : signals_) {
      core::visit(*signal.block, [&](auto elements) {
        using T = std::remove_cvref_t<decltype(elements[0])>;
        if constexpr (std::is_arithmetic_v<T>) {
          row.push_back(static_cast<double>(elements[signal.first]));
        }
      });
    }
  }

 private:
  const core::System& system_;
  Results& results_;
  std::vector<core::Signal> signals_;
};

std::unique_ptr<core::Unit> serve(const std::shared_ptr<importer::Fmu>& fmu,
                                  const std::string& name, const importer::InstanceOptions& options,
                                  const isolation::HostOptions& host) {
  remote::RemoteSpec spec{
      .place = remote::parse_place("exec:exec " + stride_program().string() + " serve"),
      .fmu = fmu->path().string()};
  auto unit = std::make_unique<remote::RemoteUnit>(std::move(spec), fmu, name, options, host);
  unit->instantiate();
  return unit;
}

}  // namespace

std::shared_ptr<importer::Fmu> test_unit(const std::string& name) {
  static std::map<std::string, std::shared_ptr<importer::Fmu>> loaded;
  std::shared_ptr<importer::Fmu>& fmu = loaded[name];
  const bool is_of_kit = !name.starts_with("fmi2_");
  if (!fmu) fmu = importer::Fmu::load(is_of_kit ? unit_library(name) : test_fmu(name));
  return fmu;
}

Assembly& Assembly::add(const std::string& name, const std::string& unit,
                        const Values& start_values) {
  return add(name, test_unit(unit), start_values);
}

Assembly& Assembly::add(const std::string& name, std::shared_ptr<importer::Fmu> unit,
                        const Values& start_values) {
  declaration_.components.push_back({name, unit->description(), {}, {}});
  units_[name] = std::move(unit);
  for (const auto& [variable, value] : start_values) set(name + "." + variable, value);
  return *this;
}

Assembly& Assembly::wire(const std::string& from, const std::string& to) {
  const auto [source, output] = split(from);
  const auto [target, input] = split(to);
  declaration_.connections.push_back({source, output, target, input, false, {}});
  return *this;
}

Assembly& Assembly::wire_message(const std::string& from, const std::string& to) {
  for (const char* part : {".clock", ".number", ".picoseconds"}) wire(from + part, to + part);
  return *this;
}

Assembly& Assembly::set(const std::string& variable, const std::string& value) {
  const auto [component, name] = split(variable);
  declaration_.start_values.push_back({component, name, value, "", {}});
  return *this;
}

Assembly Assembly::hosted(std::set<std::string> components, bool snapshots) const {
  Assembly other = *this;
  for (core::ComponentDeclaration& component : other.declaration_.components) {
    component.has_snapshots =
        snapshots && components.count(component.name) > 0 && !component.description->can_save_state;
  }
  other.hosted_ = std::move(components);
  return other;
}

Assembly Assembly::hosted() const {
  std::set<std::string> all;
  for (const core::ComponentDeclaration& component : declaration_.components) {
    all.insert(component.name);
  }
  return hosted(std::move(all));
}

Assembly Assembly::served() const {
  Assembly other = *this;
  other.is_served_ = true;
  return other;
}

Assembly Assembly::with_own_steps(unsigned seed) const {
  Assembly other = with_any_own_steps(seed);
  for (core::ComponentDeclaration& component : other.declaration_.components) {
    if (!component.description->has_event_mode) component.own_step.reset();
  }
  return other;
}

Assembly Assembly::with_strict_own_steps(unsigned seed) const {
  Assembly other = with_any_own_steps(seed);
  std::mt19937 random(seed);
  for (core::ComponentDeclaration& component : other.declaration_.components) {
    if (!component.own_step) continue;
    component.early_return_allowed = random() % 2 == 0;
    const std::string& unit = component.description->model_identifier;
    if (random() % 2 == 0 || (unit != "linear" && unit != "listener")) continue;
    auto description = std::make_shared<core::UnitDescription>(*component.description);
    description->can_vary_step = false;
    component.description = std::move(description);
  }
  return other;
}

Assembly Assembly::with_any_own_steps(unsigned seed) const {
  const core::Interval kSteps[] = {std::chrono::microseconds(700), std::chrono::milliseconds(2),
                                   std::chrono::milliseconds(3), std::chrono::milliseconds(5)};
  Assembly other = *this;
  std::mt19937 random(seed);
  for (core::ComponentDeclaration& component : other.declaration_.components) {
    if (random() % 3 > 0) component.own_step = kSteps[random() % std::size(kSteps)];
  }
  return other;
}

Assembly Assembly::shuffled(unsigned seed) const {
  Assembly other = *this;
  std::mt19937 random(seed);
  std::shuffle(other.declaration_.components.begin(), other.declaration_.components.end(), random);
  std::shuffle(other.declaration_.connections.begin(), other.declaration_.connections.end(),
               random);
  return other;
}

std::vector<std::unique_ptr<core::Unit>> Assembly::instantiate() const {
  std::vector<std::unique_ptr<core::Unit>> units;
  for (const core::ComponentDeclaration& component : declaration_.components) {
    const importer::InstanceOptions options{.early_return_allowed = component.early_return_allowed,
                                            .intermediate_update = true};
    const std::shared_ptr<importer::Fmu>& fmu = units_.at(component.name);
    if (hosted_.count(component.name) == 0) {
      units.push_back(fmu->instantiate(component.name, options));
    } else {
      isolation::HostOptions host;
      host.takes_snapshots = component.has_snapshots;
      if (is_served_) {
        units.push_back(serve(fmu, component.name, options, host));
        continue;
      }
      units.push_back(isolation::instantiate(fmu, component.name, options, host));
    }
  }
  return units;
}

std::string Assembly::text() const {
  std::string text;
  for (const auto& component : declaration_.components) {
    text += component.name + ": " + component.description->model_name +
            (hosted_.count(component.name) > 0 ? " in a process of its own" : "");
    if (component.own_step) text += " steps of " + core::to_text(*component.own_step) + " s";
    text += component.early_return_allowed ? "\n" : ", no early return\n";
  }
  for (const auto& wire : declaration_.connections) {
    text += wire.from_component + "." + wire.from_connector + " -> " + wire.to_component + "." +
            wire.to_connector + "\n";
  }
  for (const auto& start : declaration_.start_values) {
    text += start.component + "." + start.variable + " = " + start.value + "\n";
  }
  return text;
}

double Results::value(Time time, const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::out_of_range("there is no output " + name);
  return values.at(time).at(static_cast<std::size_t>(found - names.begin()));
}

std::vector<std::string> Results::event_rows() const {
  std::vector<std::string> rows;
  std::istringstream lines(events);
  std::string row;
  std::getline(lines, row);
  while (std::getline(lines, row)) rows.push_back(row);
  std::sort(rows.begin(), rows.end());
  return rows;
}

void check_same_bytes(const Results& results, const Results& expected) {
  const bool has_same_signals = results.signals == expected.signals;  // not printed
  CHECK(has_same_signals);
  CHECK(results.events == expected.events);
}

core::RunOptions fixed_steps(Duration step, Time stop) {
  core::RunOptions options;
  options.step.size = step;
  options.stop = stop;
  options.measure_time = false;
  // not by measured costs, so that two runs save and repeat alike
  options.state_saving = {.most_steps = 5, .always = true};
  return options;
}

Results run(const Assembly& assembly, core::RunOptions options,
            const std::vector<capture::CaptureRequest>& captures) {
  const Scratch scratch;
  const core::System system(assembly.declaration());
  options.recorded = all_outputs(system);
  Results results;
  recorders::CsvRecorder signals(system, scratch / "signals.csv");
  recorders::EventRecorder events(system, scratch / "events.csv");
  ValueRecorder values(system, results);
  capture::Capture capture(system, "assembly", options, captures);
  auto units = assembly.instantiate();
  capture.wrap(units, options);
  core::Simulation simulation(system, std::move(units), options);
  capture.follow(simulation);
  for (core::Observer* observer :
       std::initializer_list<core::Observer*>{&signals, &events, &values, &capture}) {
    simulation.add_observer(*observer);
  }
  simulation.run();
  capture.end("completed");
  results.signals = read(scratch / "signals.csv");
  results.events = read(scratch / "events.csv");
  results.statistics = simulation.statistics();
  for (std::size_t i = 0; i < system.components().size(); ++i) {
    results.units[system.components()[i].name] = results.statistics.units[i];
  }
  return results;
}

}  // namespace stride::tests
