#include "master/loader/network/remote_unit.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/loader/network/codec.h"
#include "master/loader/network/description_files.h"
#include "master/loader/network/unit_files.h"

namespace stride::remote {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kSentPiece = std::size_t{1} << 20;  // of a file that is sent

}  // namespace

// ---- Life cycle ----

RemoteUnit::RemoteUnit(RemoteSpec spec, std::shared_ptr<importer::Fmu> fmu, std::string name,
                       importer::InstanceOptions options, isolation::HostOptions host)
    : spec_(std::move(spec)),
      fmu_(std::move(fmu)),
      name_(std::move(name)),
      options_(std::move(options)),
      host_(std::move(host)),
      description_(options_.description ? options_.description : fmu_->description()) {
  ConnectionOptions connection = connection_options(spec_, options_.where);
  connection.context.unit = name_;
  connection.interrupted = options_.interrupted;
  connection.note = [this](const std::string& line) {
    log_from_there(importer::Status::Ok, "stride", line);
  };
  connection_.emplace(std::move(connection));
}

RemoteUnit::~RemoteUnit() {
  try {
    RemoteUnit::free();
  } catch (const std::exception& failure) {
    log(importer::Status::Warning, "stride", fmt::format("its end failed: {}", failure.what()));
  }
  close();
}

void RemoteUnit::instantiate() {
  connection_->greet();
  if (!spec_.sent.empty()) send_file();
  call(
      "the instantiation", [&](wire::Request::Builder request) { fill(request.initInstantiate()); },
      [&](wire::Result::Reader result) {
        if (!result.isInstance()) throw BadMessage("an answer of another kind");
        capabilities_ = take_capabilities(result.getInstance(), declared_capabilities());
        take_protections(result.getInstance(), statistics_);
      });
  has_unit_ = true;
  for (const core::CapabilityId id :
       {core::CapabilityId::UnitDiagnostics, core::CapabilityId::HostDiagnostics,
        core::CapabilityId::ConcurrentSteps}) {
    capabilities_.set(static_cast<std::size_t>(id));
  }
}

isolation::CapabilitySet RemoteUnit::declared_capabilities() const {
  isolation::CapabilitySet declared;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    declared.set(i, importer::declares(*description_, static_cast<core::CapabilityId>(i)));
  }
  if (host_.takes_snapshots) declared.set(static_cast<std::size_t>(core::StateSaving::kId));
  return declared;
}

void RemoteUnit::fill(wire::Instantiate::Builder to) const {
  to.setFmu(spec_.fmu);
  to.setDigest(description_digest(fmu_->description_files()));
  to.setName(name_);
  to.setFile(options_.where.file);
  to.setLine(options_.where.line);
  to.setEarlyReturnAllowed(options_.early_return_allowed);
  to.setIntermediateUpdate(options_.intermediate_update);
  to.setMayGoBack(options_.may_go_back);
  to.setDebugLogging(options_.debug_logging);
  if (options_.step) {
    put_time(to.initStep(), Time(options_.step->rounded()));
    to.setStepSeconds(options_.step->seconds());
  }
  std::map<core::ValueReference, std::size_t> sizes;
  for (const core::Variable& variable : description_->variables) {
    for (const core::Dimension& dimension : variable.dimensions) {
      if (dimension.parameter) sizes.emplace(*dimension.parameter, dimension.size);
    }
  }
  auto list = to.initSizes(static_cast<unsigned>(sizes.size()));
  unsigned at = 0;
  for (const auto& [parameter, elements] : sizes) {
    list[at].setParameter(parameter);
    list[at++].setElements(elements);
  }
  to.setCanSaveState(description_->can_save_state);
  to.setCanSerializeState(description_->can_serialize_state);
  to.setCallLimit(host_.call_limit ? static_cast<std::uint64_t>(host_.call_limit->count()) : 0);
  to.setMemoryLimit(host_.memory_limit.value_or(0));
  to.setIsSandboxed(host_.is_sandboxed);
  to.setTakesSnapshots(host_.takes_snapshots);
}

void RemoteUnit::send_file() {
  const core::Descriptor file = core::open_input(spec_.sent, options_.where);
  std::string bytes(kSentPiece, '\0');
  bool is_first = true;
  for (std::size_t size = kSentPiece; size == kSentPiece; is_first = false) {
    size = core::read_from(file, bytes.data(), bytes.size());
    if (size == 0 && !is_first) break;
    call("the transfer of its FMU", [&](wire::Request::Builder request) {
      auto piece = request.initSendFile();
      piece.setName(spec_.sent.filename().string());
      piece.setBytes(to_data(bytes.data(), size));
      piece.setIsFirst(is_first);
    });
  }
}

core::Capability* RemoteUnit::find_capability(core::CapabilityId id) {
  if (!capabilities_.test(static_cast<std::size_t>(id))) return nullptr;
  return implemented(id);
}

void RemoteUnit::terminate() {
  drop_step();
  if (!connection_ || connection_->has_failed()) return;
  fetch_statistics();
  call("its end", [](wire::Request::Builder request) { request.setTerminate(); });
}

/// Its files come back also if the unit has failed.
void RemoteUnit::free() {
  drop_step();
  if (std::exchange(is_freed_, true) || !connection_ || connection_->has_failed()) return;
  if (has_unit_) {
    fetch_statistics();
    std::exception_ptr failure;
    try {
      call("its end", [](wire::Request::Builder request) { request.setFree(); });
    } catch (const core::Error&) {
      failure = std::current_exception();
    }
    if (!connection_->has_failed()) fetch_files();
    if (failure) std::rethrow_exception(failure);
  }
  close();
}

void RemoteUnit::close() noexcept {
  if (!connection_) return;
  statistics_.link = connection_->statistics();
  connection_.reset();
}

void RemoteUnit::fetch_statistics() {
  call(
      "its statistics", [](wire::Request::Builder request) { request.setGetStatistics(); },
      [&](wire::Result::Reader result) {
        if (result.isStatistics()) take_statistics(result.getStatistics(), statistics_);
      });
}

void RemoteUnit::fetch_files() {
  if (options_.results.empty()) return;
  UnitFileWriter writer(options_.results,
                        {.where = options_.where, .unit = name_, .time = times_.now});
  send("the transfer of its files", [](wire::Request::Builder request) { request.setGetFiles(); });
  guard([&] {
    for (;;) {
      const wire::Reply::Reader reply = connection_->receive();
      if (reply.isFile()) {
        const auto piece = reply.getFile();
        const auto bytes = piece.getBytes().asChars();
        writer.take(to_string(piece.getName()), {bytes.begin(), bytes.size()}, piece.getIsFirst());
        continue;
      }
      bool is_result = false;
      const wire::Result::Reader result = take_reply(reply, is_result);
      if (!is_result) continue;
      const std::string left_out = result.isText() ? to_string(result.getText()) : "";
      if (!left_out.empty()) log_from_there(importer::Status::Warning, "stride", left_out);
      return;
    }
  });
}

/// Asks the machine, unless it is busy or lost, which changes nothing of the unit.
core::HostStatistics RemoteUnit::host_statistics() const {
  if (has_unit_ && !is_freed_ && !step_ && connection_ && !connection_->has_failed()) {
    try {
      const_cast<RemoteUnit*>(this)->fetch_statistics();
    } catch (const core::Error&) {  // then the latest ones are those to report
    }
  }
  core::HostStatistics statistics = statistics_;
  if (connection_) statistics.link = connection_->statistics();
  return statistics;
}

// ---- Requests ----

wire::Result::Reader RemoteUnit::await_result() {
  for (;;) {
    const wire::Reply::Reader reply = connection_->receive();
    bool is_result = false;
    const wire::Result::Reader result = take_reply(reply, is_result);
    if (is_result) return result;
  }
}

wire::Result::Reader RemoteUnit::take_reply(wire::Reply::Reader reply, bool& is_result) {
  switch (reply.which()) {
    case wire::Reply::DONE:
      is_result = true;
      note_time(reply.getDone());
      return reply.getDone();
    case wire::Reply::FAILED:
      throw_error(reply.getFailed(), {.where = options_.where, .unit = name_}, spec_.place.machine);
    case wire::Reply::CALLBACK_FAILED:
      input_update_.rethrow_failure();
      throw BadMessage("inputs have failed that nobody has asked for");
    case wire::Reply::INPUTS_NEEDED:
      update_inputs(reply.getInputsNeeded());
      return {};
    case wire::Reply::LOG:
      log_from_there(reply.getLog());
      return {};
    default:
      throw BadMessage("an answer that nobody has asked for");
  }
}

void RemoteUnit::update_inputs(double seconds_into_step) {
  const bool are_set = input_update_.run(seconds_into_step);
  connection_->put([&](wire::Request::Builder request) {
    if (are_set) {
      request.setInputsUpdated();
    } else {
      request.setInputsNotUpdated();
    }
  });
  connection_->send("a step");
}

/// What the wait was longer than the work there is the network's.
void RemoteUnit::note_time(wire::Result::Reader result) {
  calls_ = result.getCalls();
  const auto now = Clock::now();
  const auto worked = std::chrono::nanoseconds(std::min<std::uint64_t>(
      result.getNanoseconds(),
      static_cast<std::uint64_t>(std::chrono::nanoseconds(now - sent_at_).count())));
  const std::chrono::nanoseconds lost = now - sent_at_ - worked;
  least_lost_ = std::min(least_lost_, lost);
  connection_->statistics().lost += std::min<std::chrono::nanoseconds>(lost, now - waited_from_);
  step_time_ = std::min<std::chrono::nanoseconds>(worked + least_lost_, now - sent_at_);
}

void RemoteUnit::log_from_there(wire::LogMessage::Reader message) const {
  const auto status = std::min<std::uint8_t>(message.getStatus(),
                                             static_cast<std::uint8_t>(importer::Status::Pending));
  log_from_there(static_cast<importer::Status>(status), to_string(message.getCategory()),
                 to_string(message.getText()));
}

void RemoteUnit::log_from_there(importer::Status status, const std::string& category,
                                const std::string& text) const {
  log(status, category, fmt::format("({}) {}", spec_.place.machine, text));
}

void RemoteUnit::log(importer::Status status, const std::string& category,
                     const std::string& text) const {
  try {
    if (options_.log) options_.log(name_, status, category, text);
  } catch (...) {  // as in the unit's own process, where nothing may cross its C code
  }
}

}  // namespace stride::remote
