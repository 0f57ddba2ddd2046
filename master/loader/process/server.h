#ifndef STRIDE_MASTER_LOADER_PROCESS_SERVER_H
#define STRIDE_MASTER_LOADER_PROCESS_SERVER_H

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include <sys/types.h>

#include "master/base/child_process/doorbell.h"
#include "master/base/child_process/sandbox.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/unit.h"
#include "master/loader/process/host_link.h"
#include "master/loader/process/hosted_unit_spec.h"
#include "master/loader/process/log_message.h"
#include "master/loader/process/snapshots.h"
#include "master/loader/wire/dispatcher.h"
#include "master/loader/wire/packet.h"

namespace stride::isolation {

/// The host of a unit: it serves the master's requests one after the other.
class Server final : private core::StateSaving {
 public:
  Server(HostLink& link, const HostedUnitSpec& spec, pid_t supervisor);

  /// Returns when the unit was destroyed, because the master wanted it. The master still waits for
  /// confirm_end().
  void run();
  /// After the exit functions of the unit. Does nothing if the master does not want the end.
  void confirm_end();

 private:
  /// All that has to be so before code of the unit runs in this process.
  Protections prepare();

  void await_request();
  /// Carries out the present request, and replies.
  void serve();
  void handle(RequestCode request, PacketReader& in, PacketWriter& out);
  void reply(ReplyCode what, const PacketWriter& packet);

  void instantiate(PacketWriter& out);
  void free();
  void request_inputs(double seconds_into_step);

  // Snapshots, in place of the unit's own states.
  void save_state() override;
  void restore_state() override;
  void select_state(std::size_t slot) override { slot_ = slot; }

  RequestCode requested() const;
  core::Context context() const;
  core::Error error_of(const std::exception& error) const;

  HostLink& link_;
  HostLinkMemory& memory_;
  const HostedUnitSpec& spec_;
  LogWriter log_;
  Waiter waiter_;
  std::optional<Snapshots> snapshots_;
  std::size_t slot_ = 0;            ///< of them
  std::uint64_t undone_calls_ = 0;  ///< of functions of the unit, by processes taken back
  std::unique_ptr<core::Unit> unit_;
  Dispatcher dispatcher_;
  core::UnitDiagnostics* diagnostics_ = nullptr;  ///< of the unit, while there is one
  bool is_over_ = false;
};

/// Runs a server in a fresh fork: its surroundings first.
void serve(HostLink& link, const HostedUnitSpec& spec, pid_t supervisor) noexcept;

}  // namespace stride::isolation

#endif
