// What a unit's process and the master have in common: requests, replies, and logged and printed
// lines.
#ifndef STRIDE_MASTER_LOADER_PROCESS_HOST_LINK_H
#define STRIDE_MASTER_LOADER_PROCESS_HOST_LINK_H

#include <atomic>
#include <cstddef>
#include <cstdint>

#include <sys/types.h>

#include "master/base/child_process/doorbell.h"
#include "master/base/child_process/shared_memory.h"
#include "master/loader/fmu/instance/call_note.h"
#include "master/loader/process/byte_ring.h"
#include "master/loader/process/snapshot_board.h"

namespace stride::isolation {

/// What the master asks for: the functions of core::Unit and its capabilities, and what they need
/// besides.
enum class RequestCode : std::uint32_t {
  Instantiate,
  EnterConfigurationMode,
  ExitConfigurationMode,
  EnterInitialization,
  ExitInitialization,
  Get,
  Set,
  MakePlan,
  Step,  ///< by such a plan, with the state saved before if that is asked for
  SaveState,
  RestoreState,
  SelectState,
  SerializeState,
  DeserializeState,
  Reset,
  EnterEventMode,
  UpdateDiscreteStates,
  EnterStepMode,
  GetClockInterval,
  GetClockShift,
  GetDirectionalDerivative,
  SetInputUpdate,
  EnableIdleSkipping,
  SetIdleTolerances,
  GetIdleUntil,
  GetDerivatives,
  DescribeMessage,
  Terminate,
  Free,              ///< destroys the unit; the process ends afterwards
  InputsUpdated,     ///< in answer to RequestInputs: the inputs are set
  InputsNotUpdated,  ///< likewise: that has failed
};

/// The answer of the unit's process to a request.
enum class ReplyCode : std::uint32_t {
  Done,
  Failed,          ///< a core::Error
  CallbackFailed,  ///< what failed is what the master did within the call
  RequestInputs,   ///< a question within a step; the reply to the step's request comes later
};

/// One direction. The writer sets what and size first, then the number, then rings.
struct alignas(64) Turn {
  std::atomic<std::uint32_t> number = 0;
  std::atomic<std::uint32_t> what = 0;  ///< a RequestCode or a ReplyCode
  std::atomic<std::uint64_t> size = 0;  ///< of the packet [byte]
  Doorbell doorbell;                    ///< for the process that waits
};

/// In shared memory. The packets themselves are in a GrowingMemory beside it, where each replaces
/// the one before. Replies have the number of their request, so neither
/// side keeps a state, and any process that becomes the active one may continue with it.
///
/// The unit's process may write anything here: sizes are checked, and what is no such value is an
/// error.
struct HostLinkMemory {
  Turn request;  ///< the unit's process waits for it
  Turn reply;    ///< the master waits for it, for the end, and for logged lines that do not fit
  std::atomic<std::uint64_t> calls = 0;  ///< of functions of the unit

  /// The active process of the unit. The end of any other does not matter.
  std::atomic<pid_t> active = 0;

  std::atomic<std::uint64_t> most_memory = 0;  ///< resident, of those that have ended [byte]
  SnapshotBoard snapshots;

  importer::CallNote call_note;
  ByteRing logged;   ///< messages of the unit, see log_message.h; written by its process
  ByteRing printed;  ///< standard output and error; written by the supervisor
};

/// Both kinds of memory. Made by the master, inherited by the others.
struct HostLink {
  Shared<HostLinkMemory> memory;
  GrowingMemory packets{"stride-unit", std::size_t{1} << 16};
};

}  // namespace stride::isolation

#endif
