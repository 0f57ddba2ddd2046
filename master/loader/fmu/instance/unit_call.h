// The calls of units that have not returned, for the end of a process.
#ifndef STRIDE_MASTER_LOADER_FMU_INSTANCE_UNIT_CALL_H
#define STRIDE_MASTER_LOADER_FMU_INSTANCE_UNIT_CALL_H

#include <optional>
#include <string>
#include <vector>

#include <stride/time.h>

#include "master/base/error.h"
#include "master/loader/fmu/library/shared_library.h"

namespace stride::importer {

struct UnitCall {
  std::string function;
  std::string unit;
  core::Location where;  ///< the component's position in the scenario
  std::optional<Time> time;
  std::string variable;  ///< whose value is being read from the memory of the unit, or empty
  bool is_by_thread = false;
};

/// Whether there is one in this process. Can be called by a signal handler.
bool is_any_call_unfinished() noexcept;

/// Those of this process; which of them are by this thread, given by its address of this_thread.
/// For a fork of a process that must end.
std::vector<UnitCall> unfinished_calls(const char* thread);

/// The last call that this thread has made, if its instance still exists; it has returned. For a
/// fork of a process that must end.
std::optional<UnitCall> last_call_of_this_thread();

/// To be called before a process is forked that is watched, and when it has ended: the calls that
/// it has left, without variables, and the work on libraries. It may have damaged anything that is
/// read here.
void share_calls();
std::vector<UnitCall> left_calls(const char* thread);
LibraryWork left_library_work();

}  // namespace stride::importer

#endif
