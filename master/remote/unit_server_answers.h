// How UnitServer answers: for its own sources only.
#ifndef STRIDE_MASTER_REMOTE_UNIT_SERVER_ANSWERS_H
#define STRIDE_MASTER_REMOTE_UNIT_SERVER_ANSWERS_H

#include "master/remote/unit_server.h"

namespace stride::remote {

/// What the master did for the unit within a step has failed; it knows how.
struct CallbackFailure {};

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
