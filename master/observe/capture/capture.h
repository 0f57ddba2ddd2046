// stride run --capture: what components receive in a run, kept to be played to them again.
#ifndef STRIDE_MASTER_OBSERVE_CAPTURE_CAPTURE_H
#define STRIDE_MASTER_OBSERVE_CAPTURE_CAPTURE_H

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "master/engine/model/system/system.h"
#include "master/engine/port/observer.h"
#include "master/engine/run/context/run_options.h"
#include "master/engine/run/simulation.h"
#include "master/observe/capture/captured_unit.h"

namespace stride::capture {

struct CaptureRequest {
  std::string component;
  std::filesystem::path file;
};

/// The file of a component's stimuli, in a folder of such files.
std::string stimuli_file_name(const std::string& component);
/// The folder in which the stimuli go on that a run has captured, if its results go on in another
/// one.
std::filesystem::path copied_stimuli(const std::filesystem::path& results);

/// Call order: construction, wrap(), follow(), add_observer() before the run; end() behind it. The
/// files hold all up to the last communication point that was reached, whatever ended the run.
class Capture final : public core::Observer {
 public:
  /// Creates the files, or goes on with those that are there. Throws core::Error (Input) for a
  /// component that the system has not, one that is named twice, a file that is named twice or
  /// cannot be created, and options with which inputs change within a step.
  Capture(const core::System& system, const std::string& system_name,
          const core::RunOptions& options, std::span<const CaptureRequest> requests,
          core::OutputFile::Existing existing = core::OutputFile::Existing::Emptied);

  bool is_empty() const { return files_.empty(); }
  /// Puts a CapturedUnit around each unit that is to be captured; the others stay as they are. The
  /// run must save their states before each step: what is committed must not be repeated.
  void wrap(std::vector<std::unique_ptr<core::Unit>>& units, core::RunOptions& options);
  /// The simulation that the units go into; it must outlive the run only.
  void follow(const core::Simulation& simulation);

  void on_communication_point(Time time) override;
  /// At a communication point, of the captured units and their files, which a run that goes on was
  /// constructed to keep.
  void persist(core::StateArchive& state);
  /// core::OutputFile::go_on() for each.
  void go_on();
  /// In a fork of the process, behind a flush() in that one: goes on in copies in this folder,
  /// which is made.
  void continue_in_copies(const std::filesystem::path& folder);
  /// Hands to the system what is committed.
  void flush();
  void on_finish() override { flush(); }

  /// Writes the end mark: why the run ended. Throws core::Error (Run) if that fails.
  void end(const std::string& ending);

 private:
  struct File {
    std::size_t component;
    std::unique_ptr<StimuliFile> file;
    CapturedUnit* unit = nullptr;
  };

  void open(const core::System& system, const std::string& system_name,
            const CaptureRequest& request, std::span<const CaptureRequest> earlier,
            core::OutputFile::Existing existing);

  const core::System& system_;
  std::vector<File> files_;
  SuperDenseIndex index_;
};

}  // namespace stride::capture

#endif
