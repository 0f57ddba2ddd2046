// Which unit of which machine, and what is asked of it before it runs.
#ifndef STRIDE_MASTER_LOADER_NETWORK_REMOTE_SPEC_H
#define STRIDE_MASTER_LOADER_NETWORK_REMOTE_SPEC_H

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>

#include "master/loader/fmu/fmu.h"
#include "master/loader/network/connection.h"
#include "master/loader/wire/codec.h"

namespace stride::remote {

/// What a unit elsewhere is, and where.
struct RemoteSpec {
  Place place{};
  std::string fmu{};             ///< its path or name there; empty: the only one that is offered
  std::filesystem::path sent{};  ///< a file of this machine that is sent in its place; or empty
  std::chrono::milliseconds connect_limit = std::chrono::seconds(60);
  std::chrono::milliseconds silence_limit = std::chrono::seconds(30);
  const volatile std::sig_atomic_t* interrupted = nullptr;  ///< ends a wait; null = nothing does
};

/// The FMU that a spec names: the description of the one that is there, or, where a file is sent,
/// of that file. Throws core::Error at `where`, also for a machine that cannot be reached.
std::shared_ptr<importer::Fmu> describe(const RemoteSpec& spec, const core::Location& where);

/// What a machine answers, and how fast.
struct Trial {
  std::chrono::nanoseconds connecting{};
  std::chrono::nanoseconds round_trip{};  ///< the median of some
};
/// Connects and asks for nothing. Throws core::Error likewise.
Trial try_connection(const RemoteSpec& spec, const core::Location& where);

/// Of a connection to it, for a component at that place of the scenario.
ConnectionOptions connection_options(const RemoteSpec& spec, const core::Location& where);

/// Makes it the error of what was asked of a machine: with the place and the component that are
/// known here, and with the machine's name before the message, which then also has the place that
/// it has there.
void supplement(isolation::SentError& error, const core::Context& here, const std::string& machine);

/// Carries out what reads messages. A mistake in them is a failure of the connection.
template <class Action>
decltype(auto) checked(Connection& connection, Action&& action) {
  try {
    return action();
  } catch (const BadPacket& mistake) {
    connection.fail_bad_message(mistake.what());
  }
}

}  // namespace stride::remote

#endif
