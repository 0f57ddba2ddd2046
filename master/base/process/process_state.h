// What the code of a unit can change for all other code in its process.
#ifndef STRIDE_MASTER_BASE_PROCESS_PROCESS_STATE_H
#define STRIDE_MASTER_BASE_PROCESS_PROCESS_STATE_H

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>

#include "master/base/files/descriptor.h"
#include "master/base/files/file_identity.h"
#include "master/base/process/environment.h"
#include "master/base/process/locale_state.h"
#include "master/base/process/processor_mode.h"
#include "master/base/process/signal_state.h"

namespace stride::core {

/// What all code in a process shares, beside memory and open files: the working folder, the mask of
/// the modes of new files, resource limits, environment variables, signals, the locale, and, in the
/// calling thread, the mode of the processor.
///
/// An object has what is so when it is made. It belongs to one thread, and no other thread may
/// change these things or read the environment meanwhile. Making and restoring take some tens of
/// microseconds at most.
class ProcessState {
 public:
  enum class Extent {
    Everything,
    /// What numbers depend on: the mode of the processor and the locale.
    Numbers,
  };

  explicit ProcessState(Extent extent = Extent::Everything);

  /// Puts back what differs, and returns it in words: "the working folder". What the system does
  /// not allow to be put back is among it, and says so. Limits that have become wider stay.
  std::vector<std::string> restore() const;

 private:
  /// Of what is not only for numbers.
  struct Rest {
    Rest();
    void restore(std::vector<std::string>& changes) const;
    void restore_folder(std::vector<std::string>& changes) const;
    void restore_limits(std::vector<std::string>& changes) const;

    static constexpr std::array kLimits{RLIMIT_CPU,   RLIMIT_FSIZE,  RLIMIT_DATA, RLIMIT_STACK,
                                        RLIMIT_NPROC, RLIMIT_NOFILE, RLIMIT_AS};
    Descriptor folder;
    std::optional<FileIdentity> folder_identity;
    std::string folder_path;
    std::array<rlimit, kLimits.size()> limits{};
    mode_t mask;
    Environment environment;
    SignalState signals;
  };

  ProcessorMode mode_ = ProcessorMode::present();
  LocaleState locale_;
  std::optional<Rest> rest_;
};

}  // namespace stride::core

#endif
