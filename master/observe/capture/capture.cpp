#include "master/observe/capture/capture.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/text/suggest.h"
#include "master/observe/recorders/unit_folders.h"

namespace stride::capture {
namespace {

[[noreturn]] void refuse(const CaptureRequest& request, const std::string& message,
                         const std::string& hint = "") {
  core::fail_input(
      {}, fmt::format("--capture {}={}: {}", request.component, request.file.string(), message),
      hint);
}

std::size_t find_component(const core::System& system, const CaptureRequest& request) {
  std::vector<std::string> names;
  for (const core::Component& component : system.components()) names.push_back(component.name);
  const auto found = std::ranges::find(names, request.component);
  if (found == names.end()) {
    refuse(request, fmt::format("there is no component '{}'", request.component),
           core::suggestion(request.component, names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::string stimuli_file_name(const std::string& component) {
  return recorders::unit_folder_name(component) + ".csv";
}

std::filesystem::path copied_stimuli(const std::filesystem::path& results) {
  return results / "stimuli";
}

Capture::Capture(const core::System& system, const std::string& system_name,
                 const core::RunOptions& options, std::span<const CaptureRequest> requests,
                 core::OutputFile::Existing existing)
    : system_(system) {
  if (!requests.empty() && options.sets_inputs_in_steps()) {
    refuse(requests.front(),
           fmt::format("with the coupling '{}' and the extrapolation '{}' inputs change within a "
                       "step, which cannot be captured",
                       core::name(options.coupling), core::name(options.extrapolation)),
           "use --coupling jacobi --extrapolation hold");
  }
  for (std::size_t i = 0; i < requests.size(); ++i) {
    open(system, system_name, requests[i], requests.first(i), existing);
  }
}

void Capture::open(const core::System& system, const std::string& system_name,
                   const CaptureRequest& request, std::span<const CaptureRequest> earlier,
                   core::OutputFile::Existing existing) {
  const std::size_t component = find_component(system, request);
  for (const CaptureRequest& other : earlier) {
    if (other.component == request.component) refuse(request, "the component is captured twice");
    if (other.file.lexically_normal() == request.file.lexically_normal()) {
      refuse(request, "the file is written twice", "name another file for each component");
    }
  }
  const Origin origin{request.component, system_name,
                      system.components()[component].description.get()};
  files_.push_back({component, std::make_unique<StimuliFile>(request.file, origin, existing)});
}

void Capture::wrap(std::vector<std::unique_ptr<core::Unit>>& units, core::RunOptions& options) {
  for (File& file : files_) {
    const core::UnitDescription& description = *system_.components()[file.component].description;
    auto captured = std::make_unique<CapturedUnit>(std::move(units[file.component]), description,
                                                   *file.file, index_);
    file.unit = captured.get();
    options.state_saving.each_step.push_back(file.component);
    units[file.component] = std::move(captured);
  }
}

void Capture::follow(const core::Simulation& simulation) {
  index_.follow(simulation.statistics().event_iterations);
}

void Capture::on_communication_point(Time time) {
  index_.on_communication_point(time);
  for (File& file : files_) file.unit->commit();
}

void Capture::persist(core::StateArchive& state) {
  state.mark("captures");
  index_.persist(state);
  state.fixed(files_, [&](File& file) { file.unit->persist(state); });
}

void Capture::go_on() {
  for (File& file : files_) file.file->file().go_on();
}

void Capture::continue_in_copies(const std::filesystem::path& folder) {
  if (!is_empty()) std::filesystem::create_directories(folder);
  for (File& file : files_) {
    const std::string& component = system_.components()[file.component].name;
    file.file->file().continue_in_copy(folder / stimuli_file_name(component));
  }
}

void Capture::flush() {
  for (File& file : files_) file.file->file().flush();
}

void Capture::end(const std::string& ending) {
  for (File& file : files_) file.file->close(ending);
}

}  // namespace stride::capture
