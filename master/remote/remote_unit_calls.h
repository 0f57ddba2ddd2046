// How RemoteUnit calls: for its own sources only.
#ifndef STRIDE_MASTER_REMOTE_REMOTE_UNIT_CALLS_H
#define STRIDE_MASTER_REMOTE_REMOTE_UNIT_CALLS_H

#include "master/remote/remote_unit.h"

namespace stride::remote {

template <class Fill, class Take>
void RemoteUnit::call(const char* name, Fill&& fill, Take&& take) {
  send(name, fill);
  receive(take);
}

template <class Fill>
void RemoteUnit::call(const char* name, Fill&& fill) {
  call(name, fill, [](wire::Result::Reader) {});
}

template <class Fill>
void RemoteUnit::send(const char* name, Fill&& fill) {
  guard([&] {
    connection_->set_time(times_.now);
    connection_->put([&](wire::Request::Builder request) {
      request.setIsAwaited(true);
      fill(request);
    });
    connection_->send(name);
  });
  sent_at_ = waited_from_ = Clock::now();
}

template <class Take>
void RemoteUnit::receive(Take&& take) {
  guard([&] { take(await_result()); });
}

template <class Fill>
void RemoteUnit::defer(Fill&& fill) {
  guard([&] {
    connection_->set_time(times_.now);
    connection_->put(fill);
  });
}

template <class Action>
void RemoteUnit::guard(Action&& action) {
  if (!connection_) {
    core::fail_run({.where = options_.where, .unit = name_, .time = times_.now},
                   "it cannot be called, because it was freed");
  }
  checked(*connection_, action);
}

}  // namespace stride::remote

#endif
