// The server's session: requests of the master, carried out on a hosted unit.
#ifndef STRIDE_MASTER_LOADER_NETWORK_SERVER_UNIT_SERVER_H
#define STRIDE_MASTER_LOADER_NETWORK_SERVER_UNIT_SERVER_H

#include <chrono>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "master/engine/port/unit.h"
#include "master/loader/network/instantiation.h"
#include "master/loader/network/message.h"
#include "master/loader/network/server/serve_options.h"
#include "master/loader/network/server/server_channel.h"
#include "master/loader/network/server/unit_offer.h"
#include "master/loader/wire/dispatcher.h"

namespace stride::remote {

/// Carries out requests, one after the other. What fails is told to the master; only the end of the
/// link, and messages that are none, end a session.
class UnitServer {
 public:
  UnitServer(ServerChannel& channel, const ServeOptions& options);

  /// Until the link ends, with LinkEnded or BadPacket. Nothing of the unit stays.
  [[noreturn]] void run();

 private:
  using Clock = std::chrono::steady_clock;

  void serve(Message<RequestHead> message);
  void handle(RequestCode request, PacketReader& in, PacketWriter& out);
  void answer(ReplyCode code, const PacketWriter& packet);

  void describe(const std::string& name, PacketWriter& out);
  void instantiate(const Instantiation& wanted, PacketWriter& out);
  std::shared_ptr<const core::UnitDescription> description_for(const Instantiation& wanted);
  void request_inputs(double seconds_into_step);
  void send_files(PacketWriter& out);
  void send_log(importer::Status status, const std::string& category, const std::string& text);

  ServerChannel& channel_;
  const ServeOptions& options_;
  UnitOffer offer_;
  std::string name_;  ///< of the component
  std::shared_ptr<const core::UnitDescription> description_;
  std::optional<archive::TemporaryFolder> results_;  ///< outlives the unit
  std::unique_ptr<core::Unit> unit_;
  isolation::Dispatcher dispatcher_;
  core::UnitDiagnostics* diagnostics_ = nullptr;  ///< of the unit
  isolation::PacketBuffer out_;  ///< for answers: each is put when its request is carried out
  Clock::time_point began_;      ///< the present request
  std::exception_ptr failure_;   ///< of a request that is not awaited
};

}  // namespace stride::remote

#endif
