#include "master/loader/process/server.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <sys/prctl.h>
#include <unistd.h>

#include "master/base/child_process/process_memory.h"
#include "master/base/child_process/surroundings.h"
#include "master/base/process/own_exit.h"
#include "master/base/process/process_state.h"
#include "master/loader/process/sandbox_hint.h"

namespace stride::isolation {
namespace {

/// Where the master is so long in coming, nothing is lost by another look.
constexpr std::chrono::seconds kMasterCheckInterval{10};

/// This process goes on where its snapshot was taken, and the request is now one to restore it.
struct TakenBack {};

/// First among the functions that exit() calls, but for the unit's own: those of the master are not
/// for this process.
void on_exit_called(int status, void* server) {
  std::fflush(nullptr);
  const bool is_own = core::OwnExit::is_caller_of(__builtin_frame_address(0));
  if (is_own) static_cast<Server*>(server)->confirm_end();
  ::_exit(status);
}

void add(Protections& protections, Protections&& further) {
  std::ranges::move(further.in_force, std::back_inserter(protections.in_force));
  std::ranges::move(further.missing, std::back_inserter(protections.missing));
}

}  // namespace

void serve(HostLink& link, const HostedUnitSpec& spec, pid_t supervisor) noexcept {
  reset_signal_handlers();
  ::prctl(PR_SET_NAME, spec.name.c_str());
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a crash loses no line
  Server server(link, spec, supervisor);
  ::on_exit(&on_exit_called, &server);
  server.run();
  core::OwnExit::begin();
  std::exit(0);
}

Server::Server(HostLink& link, const HostedUnitSpec& spec, pid_t supervisor)
    : link_(link),
      memory_(*link.memory),
      spec_(spec),
      log_(*link.memory),
      dispatcher_([this](double seconds) { request_inputs(seconds); }) {
  if (!spec.has_snapshots()) return;
  snapshots_.emplace(
      memory_.snapshots, memory_.active, supervisor,
      SnapshotOptions{context(), {link.packets.file().number()}, spec.host.memory_limit});
}

void Server::run() {
  while (!is_over_) {
    await_request();
    serve();
  }
  memory_.call_note.write("an exit function of its library");
}

void Server::confirm_end() {
  if (is_over_) reply(ReplyCode::Done, PacketWriter(link_.packets));
}

Protections Server::prepare() {
  Protections protections;
  if (spec_.host.memory_limit) {
    limit_memory(*spec_.host.memory_limit);
    protections.in_force.push_back(fmt::format(
        "at most {} MiB of memory: RLIMIT_DATA for each process, a watch over the sum of all",
        *spec_.host.memory_limit >> 20));
  }
  if (!spec_.host.is_sandboxed) return protections;
  ::setenv("TMPDIR", spec_.temporary->path().c_str(), 1);
  add(protections, enter_sandbox(writable_folders(spec_), spec_.host.memory_limit.has_value()));
  return protections;
}

// ---- Requests and replies ----

void Server::await_request() {
  const auto is_there = [&] {
    return memory_.request.number.load(std::memory_order_acquire) !=
           memory_.reply.number.load(std::memory_order_relaxed);
  };
  while (!waiter_.wait(memory_.request.doorbell, kMasterCheckInterval, is_there)) {
  }
}

RequestCode Server::requested() const {
  return static_cast<RequestCode>(memory_.request.what.load());
}

void Server::serve() {
  const std::size_t size = memory_.request.size;
  link_.packets.follow(size);
  PacketReader in({link_.packets.data(), size});
  PacketWriter out(link_.packets);
  ReplyCode what = ReplyCode::Done;
  const auto fail = [&](const core::Error& error) {
    what = ReplyCode::Failed;
    out.clear();
    put_error(out, error, context(), sandbox_hint(error.what(), spec_.name, spec_.host));
  };
  try {
    handle(requested(), in, out);
  } catch (const TakenBack&) {
    out.clear();
  } catch (const CallbackFailure&) {
    what = ReplyCode::CallbackFailed;
  } catch (const BadPacket&) {
    fail(error_of(std::runtime_error(kHasOverwritten)));
  } catch (const core::Error& error) {
    fail(error);
  } catch (const std::exception& error) {
    fail(error_of(error));
  } catch (...) {
    fail(error_of(std::runtime_error("something that is not a std::exception")));
  }
  if (!is_over_) reply(what, out);
}

void Server::reply(ReplyCode what, const PacketWriter& packet) {
  memory_.call_note.clear();
  if (diagnostics_ != nullptr) {
    memory_.calls.store(undone_calls_ + diagnostics_->calls(), std::memory_order_relaxed);
  }
  memory_.reply.what.store(static_cast<std::uint32_t>(what), std::memory_order_relaxed);
  memory_.reply.size.store(packet.size(), std::memory_order_relaxed);
  memory_.reply.number.store(memory_.request.number.load(std::memory_order_relaxed),
                             std::memory_order_release);
  memory_.reply.doorbell.ring();
}

void Server::handle(RequestCode request, PacketReader& in, PacketWriter& out) {
  if (request == RequestCode::Instantiate) return instantiate(out);
  if (request == code_of<&core::Unit::free>()) return free();
  dispatcher_.serve(request, in, out);
}

core::Context Server::context() const {
  return {
      .where = spec_.options.where, .unit = spec_.name, .variable = {}, .time = dispatcher_.time()};
}

/// Of an exception that has crossed the unit's interface, which none may, or of this process
/// itself.
core::Error Server::error_of(const std::exception& error) const {
  const std::string function(memory_.call_note.function());
  std::string text = error.what();
  if (!function.empty()) {
    text = fmt::format("{} let an exception out: {}", function, text);
  } else if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
             dynamic_cast<const std::length_error*>(&error) != nullptr) {
    text = "there is not enough memory for what was requested of it";
  }
  return {core::Error::Kind::Run, context(), text};
}

// ---- Life cycle ----

void Server::instantiate(PacketWriter& out) {
  Form<Protections>::put(out, prepare());
  importer::InstanceOptions options = spec_.options;
  options.call_note = &memory_.call_note;
  options.process = std::make_shared<core::ProcessState>(core::ProcessState::Extent::Numbers);
  options.log = [this](const std::string&, importer::Status status, const std::string& category,
                       const std::string& text) {
    log_.write({status, category, text});
  };
  memory_.call_note.write("the loading of its library");
  unit_ = spec_.fmu->instantiate(spec_.name, std::move(options));
  const bool has_own = spec_.options.description != nullptr;
  dispatcher_.begin(*unit_, has_own ? *spec_.options.description : *spec_.fmu->description(),
                    snapshots_ ? this : nullptr, false);
  diagnostics_ = &dispatcher_.capability<core::UnitDiagnostics>();
  Form<CapabilitySet>::put(out, dispatcher_.capabilities());
}

void Server::free() {
  diagnostics_ = nullptr;
  dispatcher_.end();
  if (unit_) unit_->free();
  unit_.reset();
  memory_.call_note.write("the unloading of its library");
  spec_.fmu->unload_library();
  std::fflush(nullptr);
  is_over_ = true;
}

// ---- Inputs within a step ----

/// The master may get and set before it answers.
void Server::request_inputs(double seconds_into_step) {
  PacketWriter question(link_.packets);
  question.put(seconds_into_step);
  reply(ReplyCode::RequestInputs, question);
  for (await_request(); requested() != RequestCode::InputsUpdated; await_request()) {
    if (requested() == RequestCode::InputsNotUpdated) throw CallbackFailure();
    serve();
  }
}

// ---- Snapshots ----

void Server::save_state() {
  memory_.call_note.write("the snapshot of its process");
  if (!snapshots_->save(slot_, dispatcher_.time())) return;
  undone_calls_ = memory_.calls - diagnostics_->calls();
  throw TakenBack();
}

void Server::restore_state() {
  memory_.call_note.write("the return to a snapshot of its process");
  snapshots_->restore(slot_, dispatcher_.time());
}

}  // namespace stride::isolation
