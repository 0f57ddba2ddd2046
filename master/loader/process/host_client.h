#ifndef STRIDE_MASTER_LOADER_PROCESS_HOST_CLIENT_H
#define STRIDE_MASTER_LOADER_PROCESS_HOST_CLIENT_H

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "master/base/child_process/doorbell.h"
#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/loader/process/host_link.h"
#include "master/loader/process/host_process.h"
#include "master/loader/process/hosted_unit_spec.h"
#include "master/loader/process/log_message.h"
#include "master/loader/process/output_tail.h"
#include "master/loader/wire/packet.h"

namespace stride::isolation {

/// The master's side of requests and replies, and of the process that replies. What the unit logs
/// and prints meanwhile reaches the log.
class HostClient {
 public:
  /// Starts the process. Throws std::system_error if there can be none.
  explicit HostClient(const HostedUnitSpec& spec);

  /// A packet to be written and sent; it replaces the packet before.
  PacketWriter write() { return PacketWriter(link_.packets); }
  /// Sends a request. Throws core::Error of the kind Run, at `time`, if the process has ended.
  void post(RequestCode request, const PacketWriter& packet, std::optional<Time> time);
  /// Waits for the reply. Throws likewise, if the process ends before, or is ended because its time
  /// is over: when the `limit` has passed since begin_call().
  ReplyCode await(std::optional<Time> time, std::optional<std::chrono::milliseconds> limit);
  /// The request that was just posted will be waited for later: its time counts from here.
  void begin_call() {
    if (spec_.host.call_limit) call_began_ = Clock::now();
  }
  /// The reply, until the next packet is written.
  PacketReader read();

  /// What the unit logs and prints while it repeats steps is not logged again.
  void set_repeating(bool repeating);
  /// Logs something about the unit.
  void log(importer::Status status, const std::string& category,
           const std::string& text) const noexcept;
  /// Ends the process, and logs its remaining messages.
  void finish();

  /// The process has ended, or sends what cannot be read: nothing can be sent any longer.
  bool has_failed() const { return !failure_.empty(); }
  [[noreturn]] void fail_bad_packet(std::optional<Time> time);
  /// Of snapshots and memory; also after a failure.
  core::HostStatistics statistics() const;
  std::uint64_t calls() const { return link_.memory->calls.load(std::memory_order_relaxed); }

 private:
  using Clock = std::chrono::steady_clock;

  bool has_reply() const {
    return link_.memory->reply.number.load(std::memory_order_acquire) == number_;
  }
  /// Only the master writes the number of a request; a reply has that of this one or the last.
  bool has_overwritten_number() const;
  void await_reply(std::optional<Time> time, std::optional<std::chrono::milliseconds> limit);
  Clock::time_point begin_of_call();
  void take_lines();
  void take_last_line();
  void log_printed(std::string_view line);
  void warn_of_slow_call();
  bool is_interrupted_for_long();
  [[noreturn]] void fail_interrupted(std::optional<Time> time);
  [[noreturn]] void fail(const std::string& what, std::optional<Time> time);
  std::string present_call() const;
  core::Context context(std::optional<Time> time) const;

  const HostedUnitSpec& spec_;
  HostLink link_;
  HostProcess process_;
  Waiter waiter_;
  std::uint32_t number_ = 0;  ///< of the latest request
  bool is_repeating_ = false;
  LogReader log_;
  PrintedLines printed_;
  OutputTail output_tail_;
  bool has_slow_call_warning_ = false;
  std::optional<Clock::time_point> call_began_;      ///< of a call that is waited for later
  std::optional<Clock::time_point> interrupted_at_;  ///< seen in a call
  std::string failure_;                              ///< why nothing can be sent any longer
};

}  // namespace stride::isolation

#endif
