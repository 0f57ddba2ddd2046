#include "master/loader/network/server/unit_server.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "master/loader/network/description_files.h"
#include "master/loader/network/unit_files.h"
#include "master/loader/process/hosted_unit.h"

namespace stride::remote {
namespace {

/// The smaller of two limits, where there are some.
template <class T>
std::optional<T> least(std::optional<T> a, std::optional<T> b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

template <class T>
std::optional<T> above_zero(std::uint64_t number) {
  return number == 0 ? std::nullopt : std::optional<T>(number);
}

isolation::HostOptions host_options(const Instantiation& wanted, const ServeOptions& options) {
  constexpr std::uint64_t kLongest = 1'000'000'000'000;  // [ms]
  isolation::HostOptions host;
  host.call_limit =
      least(above_zero<std::chrono::milliseconds>(std::min(wanted.call_limit, kLongest)),
            options.call_limit);
  host.memory_limit = least(above_zero<std::uint64_t>(wanted.memory_limit), options.memory_limit);
  host.is_sandboxed = wanted.is_sandboxed || !options.may_leave_sandbox;
  host.takes_snapshots = wanted.takes_snapshots;
  return host;
}

/// Who offers some units only tells nothing of where they are.
std::string told_path(const UnitOffer& offer, const importer::Fmu& fmu) {
  return (offer.is_pinned() ? fmu.path().filename() : fmu.path()).string();
}

}  // namespace

UnitServer::UnitServer(ServerChannel& channel, const ServeOptions& options)
    : channel_(channel),
      options_(options),
      offer_(options.only, options.file_limit, options.find),
      dispatcher_([this](double seconds) { request_inputs(seconds); }) {}

// ---- Requests and answers ----

void UnitServer::run() {
  for (;;) serve(Message<RequestHead>(channel_.receive()));
}

void UnitServer::serve(Message<RequestHead> message) {
  const bool is_awaited = message.head.is_awaited != 0;
  if (failure_ && !is_awaited) return;
  began_ = Clock::now();
  channel_.set_busy(true);
  PacketWriter out(out_);
  ReplyCode code = ReplyCode::Done;
  try {
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
    handle(message.head.request, message.packet, out);
  } catch (const LinkEnded&) {
    throw;
  } catch (const BadPacket&) {
    throw;
  } catch (const isolation::CallbackFailure&) {
    code = ReplyCode::CallbackFailed;
  } catch (const std::exception& error) {
    if (!is_awaited) failure_ = std::current_exception();
    code = ReplyCode::Failed;
    out.clear();
    isolation::put_error(out, error, {.unit = name_, .time = dispatcher_.time()});
  }
  if (is_awaited) answer(code, out);
  out_.trim();
  channel_.set_busy(false);
}

void UnitServer::answer(ReplyCode code, const PacketWriter& packet) {
  const std::chrono::nanoseconds taken = Clock::now() - began_;
  channel_.send({.code = code,
                 .calls = diagnostics_ == nullptr ? 0 : diagnostics_->calls(),
                 .nanoseconds = static_cast<std::uint64_t>(taken.count())},
                packet);
}

void UnitServer::handle(RequestCode request, PacketReader& in, PacketWriter& out) {
  if (request == kPing) {
    in.require_end();
  } else if (request == kDescribe) {
    describe(in.take_text(), out);
  } else if (request == kSendFile) {
    const FilePiece piece = FilePiece::take(in);
    offer_.take_piece(std::string(piece.name), piece.bytes, piece.is_first);
  } else if (request == RequestCode::Instantiate) {
    instantiate(Instantiation::take(in), out);
  } else if (request == kGetFiles) {
    send_files(out);
  } else {
    dispatcher_.serve(request, in, out);
  }
}

/// The master may get and set before it answers.
void UnitServer::request_inputs(double seconds_into_step) {
  const Clock::time_point began = began_;
  isolation::PacketBuffer memory;
  PacketWriter question(memory);
  question.put(seconds_into_step);
  channel_.send({.code = ReplyCode::RequestInputs}, question);
  for (;;) {
    const Message<RequestHead> message(channel_.receive());
    if (message.head.request == RequestCode::InputsUpdated) break;
    if (message.head.request == RequestCode::InputsNotUpdated) throw isolation::CallbackFailure();
    serve(message);
    channel_.set_busy(true);
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  began_ = began;
}

// ---- What the unit is, and its beginning ----

void UnitServer::describe(const std::string& name, PacketWriter& out) {
  const auto fmu = offer_.fmu(name);
  out.put(told_path(offer_, *fmu));
  const std::vector<importer::DescriptionFile> files = fmu->description_files();
  out.put(files.size());
  for (const importer::DescriptionFile& file : files) {
    out.put(file.name);
    out.put(file.text);
  }
}

/// As the master has it: arrays of the sizes that its structural parameters give.
std::shared_ptr<const core::UnitDescription> UnitServer::description_for(
    const Instantiation& wanted) {
  const auto fmu = offer_.fmu(wanted.fmu);
  if (description_digest(fmu->description_files()) != wanted.digest) {
    core::fail_input({.unit = name_},
                     fmt::format("'{}' there has changed since its description was read",
                                 told_path(offer_, *fmu)),
                     "start the run again");
  }
  auto description = std::make_shared<core::UnitDescription>(*fmu->description());
  if (wanted.parameters.size() != wanted.elements.size()) throw BadPacket("sizes are missing");
  for (std::size_t i = 0; i < wanted.parameters.size(); ++i) {
    if (!description->find(wanted.parameters[i]) ||
        description->resize(wanted.parameters[i], wanted.elements[i]) != nullptr) {
      throw BadPacket("an array has no such size");
    }
  }
  description->can_save_state &= wanted.can_save_state;
  description->can_serialize_state &= wanted.can_serialize_state;
  return description;
}

void UnitServer::instantiate(const Instantiation& wanted, PacketWriter& out) {
  if (unit_) throw BadPacket("there is a unit already");
  name_ = wanted.name;
  description_ = description_for(wanted);
  results_.emplace();
  importer::InstanceOptions options;
  options.early_return_allowed = wanted.early_return_allowed;
  options.intermediate_update = wanted.intermediate_update;
  options.may_go_back = wanted.may_go_back;
  options.debug_logging = wanted.debug_logging;
  if (wanted.has_step) options.step = wanted.step;
  if (options.step && options.step->rounded() <= Duration{}) {
    throw BadPacket("a step has no such size");
  }
  options.interrupted = &channel_.is_over();
  options.log = [this](const std::string&, importer::Status status, const std::string& category,
                       const std::string& text) { send_log(status, category, text); };
  options.where = {wanted.file, wanted.line};
  options.results = results_->path();
  options.description = description_;
  isolation::HostOptions host = host_options(wanted, options_);
  host.writable.push_back(results_->path());
  unit_ =
      isolation::instantiate(offer_.fmu(wanted.fmu), name_, std::move(options), std::move(host));
  dispatcher_.begin(*unit_, *description_, nullptr, true);
  diagnostics_ = &dispatcher_.capability<core::UnitDiagnostics>();
  isolation::Form<isolation::CapabilitySet>::put(out, dispatcher_.capabilities());
  isolation::Form<core::HostStatistics>::put(
      out, dispatcher_.capability<core::HostDiagnostics>().host_statistics());
}

// ---- What is sent beside answers ----

void UnitServer::send_log(importer::Status status, const std::string& category,
                          const std::string& text) {
  isolation::PacketBuffer memory;
  PacketWriter out(memory);
  out.put(static_cast<std::uint8_t>(status));
  out.put(category);
  out.put(text);
  channel_.send({.code = kLog}, out);
}

/// Those that cannot be sent are said.
void UnitServer::send_files(PacketWriter& out) {
  std::string left_out;
  if (results_) {
    isolation::PacketBuffer memory;
    left_out = read_unit_files(results_->path(),
                               [&](const std::string& name, std::string_view bytes, bool is_first) {
                                 PacketWriter piece(memory);
                                 FilePiece{name, bytes, is_first}.put(piece);
                                 channel_.send({.code = kFile}, piece);
                               });
  }
  out.put(left_out);
}

}  // namespace stride::remote
