// What several tests of master/system/ssp share.
#ifndef STRIDE_TESTS_MASTER_SYSTEM_SSP_SUPPORT_H
#define STRIDE_TESTS_MASTER_SYSTEM_SSP_SUPPORT_H

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "master/engine/model/system/system.h"
#include "tests/error_of.h"

namespace stride::tests {

/// A folder that goes when the test goes.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "stride-io-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp failed");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A .ssd with this inside its root element, and this before it in the root's start tag. The
/// content begins in line 3.
inline std::string ssd(const std::string& inside, const std::string& version = "2.0") {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<ssd:SystemStructureDescription name=\"test\" version=\"" +
         version +
         "\" xmlns:ssd=\"http://ssp-standard.org/SSP1/SystemStructureDescription\" "
         "xmlns:ssc=\"http://ssp-standard.org/SSP1/SystemStructureCommon\" "
         "xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\">\n" +
         inside + "\n</ssd:SystemStructureDescription>\n";
}

/// A .ssd with these elements in its system's <Elements> (from line 5 on) and this behind them.
inline std::string ssd_with(const std::string& elements, const std::string& behind = "",
                            const std::string& version = "2.0") {
  return ssd("<ssd:System name=\"root\">\n<ssd:Elements>\n" + elements + "\n</ssd:Elements>\n" +
                 behind + "\n</ssd:System>",
             version);
}

inline core::Variable variable(const std::string& name, core::ValueReference reference,
                               core::ValueType type,
                               core::Causality causality = core::Causality::Output,
                               const std::string& unit = "") {
  core::Variable made;
  made.name = name;
  made.reference = reference;
  made.type = type;
  made.causality = causality;
  made.variability = type == core::ValueType::Float64 ? core::Variability::Continuous
                                                      : core::Variability::Discrete;
  made.unit = unit;
  return made;
}

/// A unit with one variable of each sort: scalars and an array, a message with its clock, a bare
/// clock, a parameter, and the time.
inline std::shared_ptr<core::UnitDescription> sample_description() {
  using core::Causality;
  using core::ValueType;
  auto description = std::make_shared<core::UnitDescription>();
  description->fmi_version = "3.0";
  description->model_name = "Sample";
  description->units_of_measure["m"] = {{0, 1, 0, 0, 0, 0, 0, 0}, 1, 0};
  description->units_of_measure["degC"] = {{0, 0, 0, 0, 1, 0, 0, 0}, 1, 273.15};
  auto& variables = description->variables;
  variables.push_back(variable("time", 0, ValueType::Float64, Causality::Independent));
  variables.push_back(variable("distance", 1, ValueType::Float64, Causality::Output, "m"));
  variables.back().aliases = {"range"};
  variables.push_back(variable("led", 2, ValueType::Boolean));
  variables.push_back(variable("frames.count", 3, ValueType::Int32));
  variables.push_back(variable("position", 4, ValueType::Float64, Causality::Output, "m"));
  variables.back().dimensions = {3};
  variables.back().size = 3;
  variables.push_back(variable("label", 5, ValueType::String));
  variables.push_back(variable("digest", 6, ValueType::Binary));
  variables.push_back(variable("transmit.clock", 7, ValueType::Clock));
  variables.back().clock.emplace();
  variables.push_back(variable("transmit.frame", 8, ValueType::Binary));
  variables.back().clocks = {7};
  variables.push_back(variable("tick", 9, ValueType::Clock));
  variables.back().clock.emplace();
  variables.push_back(variable("gain", 10, ValueType::Float64, Causality::Parameter));
  variables.push_back(variable("temperature", 11, ValueType::Float64, Causality::Input, "degC"));
  variables.push_back(variable("mode", 12, ValueType::Enumeration));
  variables.back().items = {{"off", 1}, {"on <&>", 2}};
  return description;
}

/// A unit with a time-based clock, and what is sampled and put out at its ticks.
inline core::System sampled_system() {
  using core::Causality;
  using core::ValueType;
  auto description = std::make_shared<core::UnitDescription>();
  description->has_event_mode = true;
  auto& variables = description->variables;
  variables.push_back(variable("tick", 1, ValueType::Clock, Causality::Input));
  variables.back().clock.emplace().variability = core::IntervalVariability::Countdown;
  variables.push_back(variable("u", 2, ValueType::Float64, Causality::Input));
  variables.back().clocks = {1};
  variables.push_back(variable("y", 3, ValueType::Float64, Causality::Output));
  variables.back().clocks = {1};
  core::SystemDeclaration declaration;
  declaration.components = {{"s", description, {}, {}}};
  return core::System(declaration);
}

inline core::System sample_system() {
  core::SystemDeclaration declaration;
  declaration.name = "sample";
  declaration.components = {{"a", sample_description(), {}, {}},
                            {"b, c", sample_description(), {}, {}}};
  return core::System(declaration);
}

}  // namespace stride::tests

#endif
