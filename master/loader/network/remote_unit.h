// A unit on another machine.
#ifndef STRIDE_MASTER_LOADER_NETWORK_REMOTE_UNIT_H
#define STRIDE_MASTER_LOADER_NETWORK_REMOTE_UNIT_H

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "master/loader/fmu/fmu.h"
#include "master/loader/network/connection.h"
#include "master/loader/network/instantiation.h"
#include "master/loader/network/remote_spec.h"
#include "master/loader/network/unit_files.h"
#include "master/loader/process/host_options.h"
#include "master/loader/wire/unit_proxy.h"

namespace stride::remote {

/// A stream of bytes as the carrier, to a `stride serve`. Its capabilities are those of a hosted
/// unit. A step is one round trip, with its inputs, the saving of the state before it, and its
/// outputs. What has no result goes with the next request that has one, which then throws what it
/// would have thrown.
///
/// A failure of the link is a core::Error of the kind Run with the machine and its last words;
/// after it each call but terminate() and free() throws. Files that the unit has written there are
/// in `options.results` when it is freed.
class RemoteUnit final : public isolation::UnitProxy {
 public:
  /// Starts to connect, and waits for nothing: several may do so at the same time. `fmu`: what
  /// describe() has given. To be called while this process has one thread.
  RemoteUnit(RemoteSpec spec, std::shared_ptr<importer::Fmu> fmu, std::string name,
             importer::InstanceOptions options, isolation::HostOptions host);
  ~RemoteUnit() override;

  /// Throws what the unit's own constructor throws. To be called once, before all others.
  void instantiate();

  void begin_step(const core::StepInterval& interval, const core::StepValues& values,
                  const Extras& extras) override;
  void terminate() override;
  void free() override;
  std::uint64_t calls() const override { return calls_; }
  core::HostStatistics host_statistics() const override;

 private:
  PacketWriter write() override;
  void post(RequestCode request, const PacketWriter& packet) override;
  bool defer(RequestCode request, const PacketWriter& packet) override;
  isolation::Reply await(Patience patience) override;
  bool has_failed() const override { return !connection_ || connection_->has_failed(); }
  void fail_bad_packet(const BadPacket& mistake) override {
    connection_->fail_bad_message(mistake.what());
  }
  void supplement(isolation::SentError& error) const override;
  void warn(const std::string& text) const noexcept override;

  Message<ReplyHead> receive_by(Clock::time_point end);
  void take_file(PacketReader& message);
  void log_from_there(PacketReader& message) const;
  void log_from_there(importer::Status status, const std::string& category,
                      const std::string& text) const;
  void log(importer::Status status, const std::string& category,
           const std::string& text) const noexcept;
  void note_time(const ReplyHead& head);
  isolation::CapabilitySet declared_capabilities() const;
  Instantiation instantiation() const;
  void send_file();
  void update_statistics();
  void fetch_files();
  void close() noexcept;

  RemoteSpec spec_;
  std::shared_ptr<importer::Fmu> fmu_;
  std::string name_;
  importer::InstanceOptions options_;
  isolation::HostOptions host_;
  std::shared_ptr<const core::UnitDescription> description_;
  std::optional<Connection> connection_;
  core::HostStatistics statistics_;
  std::uint64_t calls_ = 0;
  Clock::time_point sent_at_, waited_from_;  ///< the latest request, and the wait for its answer
  std::chrono::nanoseconds least_lost_ = std::chrono::nanoseconds::max();  ///< of a round trip
  bool has_unit_ = false;                                                  ///< there
  std::optional<UnitFileWriter> files_;  ///< of those that are coming back
};

}  // namespace stride::remote

#endif
