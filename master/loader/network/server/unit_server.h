// The server's session: requests of the master, carried out on a hosted unit.
#ifndef STRIDE_MASTER_LOADER_NETWORK_SERVER_UNIT_SERVER_H
#define STRIDE_MASTER_LOADER_NETWORK_SERVER_UNIT_SERVER_H

#include <array>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/unit.h"
#include "master/loader/network/message.h"
#include "master/loader/network/server/serve_options.h"
#include "master/loader/network/server/server_channel.h"
#include "master/loader/network/server/unit_offer.h"
#include "master/loader/wire/step_plan.h"

namespace stride::remote {

/// What the master did for the unit within a step has failed; it knows how.
struct CallbackFailure {};

/// Carries out requests, one after the other. What fails is told to the master; only the end of the
/// link, and messages that are none, end a session.
class UnitServer {
 public:
  UnitServer(ServerChannel& channel, const ServeOptions& options);

  /// Until the link ends, with LinkEnded or BadMessage. Nothing of the unit stays.
  [[noreturn]] void run();

 private:
  using Clock = std::chrono::steady_clock;

  void serve(wire::Request::Reader request);
  /// Calls fill(wire::Result::Builder).
  template <class Fill>
  void answer(Fill&& fill);
  void answer();
  void answer_failure(const std::exception& error);

  void handle(wire::Request::Reader request);
  void handle_mode(wire::Request::Reader request);
  void handle_state(wire::Request::Reader request);
  void handle_clock(wire::Request::Reader request);
  void handle_idle(wire::Request::Reader request);

  void describe(const std::string& name);
  void instantiate(wire::Instantiate::Reader from);
  std::shared_ptr<const core::UnitDescription> description_for(wire::Instantiate::Reader from);
  void get(wire::Block::Reader block);
  void set(wire::Request::Set::Reader from);
  void make_plan(wire::Plan::Reader plan);
  void step(wire::Step::Reader from);
  void get_directional_derivative(wire::Request::GetDirectionalDerivative::Reader from);
  void set_input_update(bool is_set);
  void request_inputs(double seconds_into_step);
  void set_idle_tolerances(wire::Request::SetIdleTolerances::Reader from);
  void get_derivatives(capnp::List<std::uint32_t>::Reader outputs);
  void free();
  void send_files();
  void send_statistics();

  core::Unit& unit() const;
  template <core::CapabilityInterface C>
  C& capability() const;
  const core::Variable& variable(core::ValueReference reference) const;
  core::Context context() const;

  ServerChannel& channel_;
  const ServeOptions& options_;
  UnitOffer offer_;
  std::string name_;  ///< of the component
  std::shared_ptr<const core::UnitDescription> description_;
  std::optional<archive::TemporaryFolder> results_;  ///< outlives the unit
  std::unique_ptr<core::Unit> unit_;
  core::UnitDiagnostics* diagnostics_ = nullptr;  ///< of the unit
  core::HostDiagnostics* host_ = nullptr;         ///< likewise
  std::array<isolation::StepBuffers, isolation::KnownStepShapes::kMost> plans_;
  std::optional<Time> time_;    ///< of the unit
  Clock::time_point began_;     ///< the present request
  std::exception_ptr failure_;  ///< of a request that is not awaited
};

template <class Fill>
void UnitServer::answer(Fill&& fill) {
  channel_.send([&](wire::Reply::Builder reply) {
    auto result = reply.initDone();
    if (diagnostics_ != nullptr) result.setCalls(diagnostics_->calls());
    result.setNanoseconds(
        static_cast<std::uint64_t>(std::chrono::nanoseconds(Clock::now() - began_).count()));
    fill(result);
  });
}

template <core::CapabilityInterface C>
C& UnitServer::capability() const {
  C* const found = unit().capability<C>();
  if (found == nullptr) throw BadMessage("a unit is asked for what it cannot");
  return *found;
}

}  // namespace stride::remote

#endif
