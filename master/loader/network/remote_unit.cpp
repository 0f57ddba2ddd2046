#include "master/loader/network/remote_unit.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/loader/network/description_files.h"

namespace stride::remote {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kSentPiece = std::size_t{1} << 20;  // of a file that is sent

const char* words_for(RequestCode request) {
  if (request == kSendFile) return "the transfer of its FMU";
  if (request == kGetFiles) return "the transfer of its files";
  return isolation::words_of(request);
}

constexpr std::pair<core::CapabilityId, const char*> kCapabilityNames[] = {
    {core::CapabilityId::ConfigurationMode, "the configuration mode"},
    {core::CapabilityId::StateSaving, "the saving of its state"},
    {core::CapabilityId::StateSerialization, "the serialization of its state"},
    {core::CapabilityId::Resetting, "the reset"},
    {core::CapabilityId::IdlePromises, "idle promises"},
    {core::CapabilityId::DirectionalDerivatives, "directional derivatives"},
    {core::CapabilityId::ClockIntervals, "the intervals of clocks"},
    {core::CapabilityId::InputsWithinStep, "inputs within steps"},
    {core::CapabilityId::MessageText, "texts of messages"},
    {core::CapabilityId::UnitDiagnostics, "diagnostics"}};

void require_capabilities(const isolation::CapabilitySet& there,
                          const isolation::CapabilitySet& declared) {
  for (const auto& [id, name] : kCapabilityNames) {
    const auto number = static_cast<std::size_t>(id);
    if (!declared.test(number) || there.test(number)) continue;
    throw BadPacket(fmt::format("the unit there lacks what its description promises: {}", name));
  }
}

}  // namespace

// ---- Life cycle ----

RemoteUnit::RemoteUnit(RemoteSpec spec, std::shared_ptr<importer::Fmu> fmu, std::string name,
                       importer::InstanceOptions options, isolation::HostOptions host)
    : UnitProxy(options.where, name, host.call_limit.value_or(options.warn_after)),
      spec_(std::move(spec)),
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
    warn(fmt::format("its end failed: {}", failure.what()));
  }
  close();
}

void RemoteUnit::instantiate() {
  connection_->greet();
  if (!spec_.sent.empty()) send_file();
  send(RequestCode::Instantiate, [&](PacketWriter& to) { instantiation().put(to); });
  receive([&](PacketReader& from) {
    const auto capabilities = isolation::Form<isolation::CapabilitySet>::take(from);
    require_capabilities(capabilities, declared_capabilities());
    set_capabilities(capabilities);
    statistics_ = isolation::Form<core::HostStatistics>::take(from);
  });
  has_unit_ = true;
}

isolation::CapabilitySet RemoteUnit::declared_capabilities() const {
  isolation::CapabilitySet declared;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    declared.set(i, importer::declares(*description_, static_cast<core::CapabilityId>(i)));
  }
  if (host_.takes_snapshots) declared.set(static_cast<std::size_t>(core::StateSaving::kId));
  return declared;
}

Instantiation RemoteUnit::instantiation() const {
  Instantiation wanted;
  wanted.fmu = spec_.fmu;
  wanted.digest = description_digest(fmu_->description_files());
  wanted.name = name_;
  wanted.file = options_.where.file;
  wanted.line = options_.where.line;
  wanted.early_return_allowed = options_.early_return_allowed;
  wanted.intermediate_update = options_.intermediate_update;
  wanted.may_go_back = options_.may_go_back;
  wanted.debug_logging = options_.debug_logging;
  wanted.has_step = options_.step.has_value();
  wanted.step = options_.step.value_or(core::Interval());
  std::map<core::ValueReference, std::uint64_t> sizes;
  for (const core::Variable& variable : description_->variables) {
    for (const core::Dimension& dimension : variable.dimensions) {
      if (dimension.parameter) sizes.emplace(*dimension.parameter, dimension.size);
    }
  }
  for (const auto& [parameter, elements] : sizes) {
    wanted.parameters.push_back(parameter);
    wanted.elements.push_back(elements);
  }
  wanted.can_save_state = description_->can_save_state;
  wanted.can_serialize_state = description_->can_serialize_state;
  wanted.call_limit = static_cast<std::uint64_t>(host_.call_limit.value_or(0ms).count());
  wanted.memory_limit = host_.memory_limit.value_or(0);
  wanted.is_sandboxed = host_.is_sandboxed;
  wanted.takes_snapshots = host_.takes_snapshots;
  return wanted;
}

void RemoteUnit::send_file() {
  const core::Descriptor file = core::open_input(spec_.sent, options_.where);
  const std::string name = spec_.sent.filename().string();
  std::string bytes(kSentPiece, '\0');
  bool is_first = true;
  for (std::size_t size = kSentPiece; size == kSentPiece; is_first = false) {
    size = core::read_from(file, bytes.data(), bytes.size());
    if (size == 0 && !is_first) break;
    send(kSendFile, [&](PacketWriter& to) {
      FilePiece{name, std::string_view(bytes).substr(0, size), is_first}.put(to);
    });
    receive([](PacketReader&) {});
  }
}

void RemoteUnit::terminate() {
  drop_step();
  if (has_failed()) return;
  update_statistics();
  UnitProxy::terminate();
}

/// Its files come back also if the unit has failed.
void RemoteUnit::free() {
  drop_step();
  if (is_freed() || has_failed()) return;
  if (has_unit_) {
    update_statistics();
    std::exception_ptr failure;
    try {
      UnitProxy::free();
    } catch (const core::Error&) {
      failure = std::current_exception();
    }
    if (!has_failed()) fetch_files();
    if (failure) std::rethrow_exception(failure);
  }
  close();
}

void RemoteUnit::close() noexcept {
  if (!connection_) return;
  statistics_.link = connection_->statistics();
  connection_.reset();
}

void RemoteUnit::update_statistics() { statistics_ = fetch_statistics(); }

void RemoteUnit::fetch_files() {
  if (options_.results.empty()) return;
  files_.emplace(options_.results, context());
  send(kGetFiles, [](PacketWriter&) {});
  const std::string left_out = receive([](PacketReader& from) { return from.take_text(); });
  if (!left_out.empty()) log_from_there(importer::Status::Warning, "stride", left_out);
}

void RemoteUnit::take_file(PacketReader& message) {
  const FilePiece piece = FilePiece::take(message);
  message.require_end();
  files_->take(std::string(piece.name), piece.bytes, piece.is_first);
}

/// Asks the machine, unless it is busy or lost, which changes nothing of the unit.
core::HostStatistics RemoteUnit::host_statistics() const {
  if (has_unit_ && !is_freed() && !is_stepping() && !has_failed()) {
    try {
      const_cast<RemoteUnit*>(this)->update_statistics();
    } catch (const core::Error&) {  // then the latest ones are those to report
    }
  }
  core::HostStatistics statistics = statistics_;
  if (connection_) statistics.link = connection_->statistics();
  return statistics;
}

// ---- The carrier ----

PacketWriter RemoteUnit::write() {
  if (!connection_) core::fail_run(context(), "it cannot be called, because it was freed");
  connection_->set_time(now());
  return connection_->write();
}

void RemoteUnit::post(RequestCode request, const PacketWriter& packet) {
  connection_->send(request, packet, words_for(request));
  if (request == RequestCode::InputsUpdated || request == RequestCode::InputsNotUpdated) return;
  sent_at_ = Clock::now();
}

bool RemoteUnit::defer(RequestCode request, const PacketWriter& packet) {
  connection_->put(request, packet);
  return true;
}

isolation::Reply RemoteUnit::await(Patience patience) {
  waited_from_ = Clock::now();
  for (;;) {
    Message<ReplyHead> reply =
        patience ? receive_by(waited_from_ + *patience) : connection_->receive();
    if (reply.head.code == kLog) {
      log_from_there(reply.packet);
    } else if (reply.head.code == kFile && files_) {
      take_file(reply.packet);
    } else {
      if (reply.head.code == ReplyCode::Done) note_time(reply.head);
      return {reply.head.code, reply.packet};
    }
  }
}

Message<ReplyHead> RemoteUnit::receive_by(Clock::time_point end) {
  const auto rest = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
  if (const auto reply = connection_->receive(std::max(0ms, rest))) return *reply;
  connection_->fail_bad_message("its step does not end");
}

/// What the wait was longer than the work there is the network's.
void RemoteUnit::note_time(const ReplyHead& head) {
  calls_ = head.calls;
  const std::chrono::nanoseconds passed = Clock::now() - sent_at_;
  const auto worked = std::chrono::nanoseconds(
      std::min(head.nanoseconds, static_cast<std::uint64_t>(passed.count())));
  const std::chrono::nanoseconds lost = passed - worked;
  least_lost_ = std::min(least_lost_, lost);
  connection_->statistics().lost +=
      std::min<std::chrono::nanoseconds>(lost, Clock::now() - waited_from_);
  set_step_time(std::min<std::chrono::nanoseconds>(worked + least_lost_, passed));
}

/// Its time is not measured by clocks of two machines.
void RemoteUnit::begin_step(const core::StepInterval& interval, const core::StepValues& values,
                            const Extras& extras) {
  UnitProxy::begin_step(interval, values, {.saves_state = extras.saves_state});
}

void RemoteUnit::supplement(isolation::SentError& error) const {
  remote::supplement(error, {.where = options_.where, .unit = name_}, spec_.place.machine);
}

// ---- The log ----

void RemoteUnit::log_from_there(PacketReader& message) const {
  const auto status =
      std::min(message.take<std::uint8_t>(), static_cast<std::uint8_t>(importer::Status::Pending));
  const std::string category = message.take_text();
  log_from_there(static_cast<importer::Status>(status), category, message.take_text());
  message.require_end();
}

void RemoteUnit::log_from_there(importer::Status status, const std::string& category,
                                const std::string& text) const {
  log(status, category, fmt::format("({}) {}", spec_.place.machine, text));
}

void RemoteUnit::warn(const std::string& text) const noexcept {
  log(importer::Status::Warning, "stride", text);
}

void RemoteUnit::log(importer::Status status, const std::string& category,
                     const std::string& text) const noexcept {
  try {
    if (options_.log) options_.log(name_, status, category, text);
  } catch (...) {  // as in the unit's own process, where nothing may cross its C code
  }
}

}  // namespace stride::remote
