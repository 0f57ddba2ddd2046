#include "master/remote/remote_unit.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "master/remote/codec.h"
#include "master/remote/description_files.h"
#include "master/remote/unit_files.h"
#include "master/util/input_file.h"

namespace stride::remote {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kSentPiece = std::size_t{1} << 20;  // of a file that is sent

/// The messages of a connection that belong to no unit, handled as they come.
wire::Result::Reader take_done(Connection& connection) {
  for (;;) {
    const wire::Reply::Reader reply = connection.receive();
    if (reply.isDone()) return reply.getDone();
    if (reply.isFailed()) throw_error(reply.getFailed());
    if (!reply.isLog()) connection.fail_bad_message("an answer that nobody has asked for");
  }
}

template <class Action>
decltype(auto) checked(Connection& connection, Action&& action) {
  try {
    return with_checked_messages(action);
  } catch (const BadMessage& mistake) {
    connection.fail_bad_message(mistake.what());
  }
}

ConnectionOptions connection_options(const RemoteSpec& spec, const core::Location& where) {
  return {.place = spec.place,
          .context = {.where = where},
          .connect_limit = spec.connect_limit,
          .silence_limit = spec.silence_limit};
}

/// What failed there is at a place here.
[[noreturn]] void rethrow_at(const core::Error& error, const core::Location& where,
                             const std::string& machine) {
  core::Context context = error.context();
  context.where = where;
  throw core::Error(error.kind(), std::move(context),
                    fmt::format("{}: {}", machine, error.message()), error.hint());
}

std::vector<importer::DescriptionFile> take_files(wire::Description::Reader description) {
  std::vector<importer::DescriptionFile> files;
  for (const auto file : description.getFiles()) {
    const auto text = file.getBytes().asChars();
    files.push_back({to_string(file.getName()), std::string(text.begin(), text.size())});
  }
  return files;
}

}  // namespace

std::shared_ptr<importer::Fmu> describe(const RemoteSpec& spec, const core::Location& where) {
  if (!spec.sent.empty()) return importer::Fmu::load(spec.sent, where);
  Connection connection(connection_options(spec, where));
  connection.greet();
  connection.put([&](wire::Request::Builder request) {
    request.setIsAwaited(true);
    request.setDescribe(spec.fmu);
  });
  connection.send("the description");
  return checked(connection, [&] {
    try {
      const wire::Result::Reader result = take_done(connection);
      if (!result.isDescription()) throw BadMessage("an answer of another kind");
      const auto description = result.getDescription();
      return make_described_fmu(
          take_files(description), where,
          fmt::format("{}:{}", spec.place.machine, to_string(description.getPath())));
    } catch (const core::EnvironmentError&) {
      throw;
    } catch (const core::Error& error) {
      if (connection.has_failed() || !error.context().where.file.empty()) throw;
      rethrow_at(error, where, connection.machine());
    }
  });
}

Trial try_connection(const RemoteSpec& spec, const core::Location& where) {
  using Clock = std::chrono::steady_clock;
  constexpr std::size_t kTrials = 15;
  const auto begin = Clock::now();
  Connection connection(connection_options(spec, where));
  connection.greet();
  const auto connected = Clock::now();
  std::vector<std::chrono::nanoseconds> times;
  while (times.size() < kTrials) {
    const auto sent = Clock::now();
    connection.put([](wire::Request::Builder request) {
      request.setIsAwaited(true);
      request.setPing();
    });
    connection.send("a round trip");
    checked(connection, [&] { take_done(connection); });
    times.push_back(Clock::now() - sent);
  }
  std::ranges::sort(times);
  return {connected - begin, times[times.size() / 2]};
}

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
  connection.note = [this](const std::string& line) { log(importer::Status::Ok, "stride", line); };
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
        capabilities_ = take_capabilities(result.getInstance());
        take_protections(result.getInstance(), statistics_);
      });
  has_unit_ = true;
  for (const core::CapabilityId id :
       {core::CapabilityId::UnitDiagnostics, core::CapabilityId::HostDiagnostics,
        core::CapabilityId::ConcurrentSteps}) {
    capabilities_.set(static_cast<std::size_t>(id));
  }
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
  if (options_.step) put_time(to.initStep(), Time(*options_.step));
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
  const core::Descriptor file = core::open_input(spec_.sent, spec_.sent.string());
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
  UnitFileWriter writer(options_.results);
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
      if (!left_out.empty()) log(importer::Status::Warning, "stride", left_out);
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
      throw_error(reply.getFailed());
    case wire::Reply::CALLBACK_FAILED:
      input_update_.rethrow_failure();
      throw BadMessage("inputs have failed that nobody has asked for");
    case wire::Reply::INPUTS_NEEDED:
      update_inputs(reply.getInputsNeeded());
      return {};
    case wire::Reply::LOG:
      log(reply.getLog());
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

void RemoteUnit::log(wire::LogMessage::Reader message) const {
  const auto status = std::min<std::uint8_t>(message.getStatus(),
                                             static_cast<std::uint8_t>(importer::Status::Pending));
  log(static_cast<importer::Status>(status), to_string(message.getCategory()),
      to_string(message.getText()));
}

void RemoteUnit::log(importer::Status status, const std::string& category,
                     const std::string& text) const {
  try {
    if (!options_.log) return;
    options_.log(name_, status, category, fmt::format("({}) {}", spec_.place.machine, text));
  } catch (...) {  // as in the unit's own process, where nothing may cross its C code
  }
}

// ---- Modes ----

void RemoteUnit::enter_configuration_mode() {
  defer([](wire::Request::Builder request) { request.setEnterConfigurationMode(); });
}

void RemoteUnit::exit_configuration_mode() {
  call("the configuration mode",
       [](wire::Request::Builder request) { request.setExitConfigurationMode(); });
}

void RemoteUnit::enter_initialization(Time start, std::optional<Time> stop) {
  times_.now = start;
  call("the initialization", [&](wire::Request::Builder request) {
    auto times = request.initEnterInitialization();
    times.setStart(to_wire(start));
    put_time(times.initStop(), stop);
  });
}

void RemoteUnit::exit_initialization() {
  call("the initialization",
       [](wire::Request::Builder request) { request.setExitInitialization(); });
}

void RemoteUnit::enter_event_mode() {
  defer([](wire::Request::Builder request) { request.setEnterEventMode(); });
}

void RemoteUnit::enter_step_mode() {
  defer([](wire::Request::Builder request) { request.setEnterStepMode(); });
}

core::EventResult RemoteUnit::update_discrete_states() {
  core::EventResult events;
  call(
      "an event", [](wire::Request::Builder request) { request.setUpdateDiscreteStates(); },
      [&](wire::Result::Reader result) {
        if (!result.isEvents()) throw BadMessage("an answer of another kind");
        events = take_events(result.getEvents());
      });
  return events;
}

// ---- Values ----

void RemoteUnit::get(References references, core::ValueBlock& values) {
  call(
      "the reading of values",
      [&](wire::Request::Builder request) { put_block(request.initGet(), references, values); },
      [&](wire::Result::Reader result) { take_values(result.getValues(), values); });
}

void RemoteUnit::set(References references, const core::ValueBlock& values) {
  defer([&](wire::Request::Builder request) {
    auto set = request.initSet();
    put_block(set.initBlock(), references, values);
    put_values(set.initValues(), values);
  });
}

void RemoteUnit::get_directional_derivative(References unknowns, References knowns,
                                            std::span<const double> seed,
                                            std::span<double> sensitivity) {
  call(
      "a derivative",
      [&](wire::Request::Builder request) {
        auto asked = request.initGetDirectionalDerivative();
        put_references(asked.initUnknowns(static_cast<unsigned>(unknowns.size())), unknowns);
        put_references(asked.initKnowns(static_cast<unsigned>(knowns.size())), knowns);
        asked.setSeed(to_data(seed));
      },
      [&](wire::Result::Reader result) { take_doubles(result.getNumbers(), sensitivity); });
}

// ---- Steps ----

core::StepResult RemoteUnit::step(const core::StepInterval& interval) {
  return step(interval, core::StepValues{});
}

core::StepResult RemoteUnit::step(const core::StepInterval& interval,
                                  const core::StepValues& values) {
  begin_step(interval, values, {});
  return finish_step();
}

core::StepResult RemoteUnit::save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                            const core::StepValues& values) {
  if (&unit != this) return StateSaving::save_with_step(unit, interval, values);
  times_.now = interval.from;
  begin_step(interval, values, {.saves_state = true});
  times_.note_saved();
  return finish_step();
}

void RemoteUnit::begin_step(const core::StepInterval& interval, const core::StepValues& values,
                            const Extras& extras) {
  const std::uint32_t plan = plan_number(values);
  times_.now = interval.from;
  send("a step", [&](wire::Request::Builder request) {
    auto step = request.initStep();
    step.setPlan(plan);
    put_interval(step, interval);
    step.setSavesState(extras.saves_state);
    put_values(step.initInputs(), values.inputs);
  });
  step_ = PresentStep{interval, values};
}

core::StepResult RemoteUnit::finish_step() {
  const PresentStep step = *std::exchange(step_, std::nullopt);
  waited_from_ = Clock::now();
  core::StepResult result;
  receive([&](wire::Result::Reader from) {
    if (!from.isStep()) throw BadMessage("an answer of another kind");
    const auto ended = from.getStep();
    result = take_result(ended, step.interval);
    if (result.rejected) {
      rejection_reason_ = to_string(ended.getReason());
    } else {
      take_values(ended.getOutputs(), step.values.outputs);
    }
  });
  if (!result.rejected) times_.now = result.reached;
  return result;
}

/// Another unit has failed, and its error ends the run. A step that does not end is no reason to
/// wait for ever.
void RemoteUnit::drop_step() noexcept {
  if (!std::exchange(step_, std::nullopt)) return;
  try {
    const auto limit = host_.call_limit.value_or(options_.warn_after);
    guard([&] {
      const auto end = Clock::now() + limit;
      for (bool is_result = false; !is_result;) {
        const auto rest =
            std::max(0ms, std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()));
        const auto reply = connection_->receive(rest);
        if (!reply) connection_->fail_bad_message("its step does not end");
        if (reply->isInputsNeeded()) {
          input_update_.set([](double) { throw std::runtime_error("its step is dropped"); });
        }
        take_reply(*reply, is_result);
      }
    });
  } catch (const std::exception& failure) {
    log(importer::Status::Warning, "stride",
        fmt::format("its step was dropped, since another unit had failed: {}", failure.what()));
  }
}

std::uint32_t RemoteUnit::plan_number(const core::StepValues& values) {
  if (const auto known = plans_.find(values)) return *known;
  const std::uint32_t number = plans_.add(values);
  defer([&](wire::Request::Builder request) {
    auto plan = request.initMakePlan();
    plan.setNumber(number);
    auto inputs = plan.initInputs(static_cast<unsigned>(values.inputs.size()));
    for (unsigned i = 0; i < inputs.size(); ++i) {
      put_block(inputs[i], values.inputs[i].references, *values.inputs[i].block);
    }
    auto outputs = plan.initOutputs(static_cast<unsigned>(values.outputs.size()));
    for (unsigned i = 0; i < outputs.size(); ++i) {
      put_block(outputs[i], values.outputs[i].references, *values.outputs[i].block);
    }
  });
  return number;
}

void RemoteUnit::set_input_update(core::InputUpdate update) {
  input_update_.set(std::move(update));
  defer([&](wire::Request::Builder request) { request.setSetInputUpdate(input_update_.is_set()); });
}

// ---- States ----

void RemoteUnit::save_state() {
  defer([](wire::Request::Builder request) { request.setSaveState(); });
  times_.note_saved();
}

void RemoteUnit::restore_state() {
  times_.go_back();
  defer([](wire::Request::Builder request) { request.setRestoreState(); });
}

void RemoteUnit::select_state(std::size_t slot) {
  defer([&](wire::Request::Builder request) {
    request.setSelectState(static_cast<std::uint32_t>(slot));
  });
  times_.select(slot);
}

std::vector<std::uint8_t> RemoteUnit::serialize_state() {
  std::vector<std::uint8_t> bytes;
  call(
      "the serialization of its state",
      [](wire::Request::Builder request) { request.setSerializeState(); },
      [&](wire::Result::Reader result) {
        const auto from = result.getBytes();
        bytes.assign(from.begin(), from.end());
      });
  return bytes;
}

/// The bytes do not contain the time.
void RemoteUnit::deserialize_state(std::span<const std::uint8_t> bytes) {
  call("the deserialization of its state", [&](wire::Request::Builder request) {
    request.setDeserializeState(to_data(bytes.data(), bytes.size()));
  });
  times_.note_unknown();
}

void RemoteUnit::reset() {
  call("the reset", [](wire::Request::Builder request) { request.setReset(); });
  times_.now.reset();
  rejection_reason_.clear();
}

void RemoteUnit::set_repeating(bool repeating) {
  if (!connection_ || connection_->has_failed()) return;
  defer([&](wire::Request::Builder request) { request.setSetRepeating(repeating); });
}

// ---- Clocks ----

core::ClockInterval RemoteUnit::clock_interval(const core::Variable& clock) {
  core::ClockInterval given;
  call(
      "the interval of a clock",
      [&](wire::Request::Builder request) { request.setGetClockInterval(clock.reference); },
      [&](wire::Result::Reader result) { given = take_clock(result.getClock()); });
  return given;
}

core::Interval RemoteUnit::clock_shift(const core::Variable& clock) {
  core::Interval shift;
  call(
      "the shift of a clock",
      [&](wire::Request::Builder request) { request.setGetClockShift(clock.reference); },
      [&](wire::Result::Reader result) { shift = take_clock(result.getClock()).interval; });
  return shift;
}

// ---- Idle time ----

void RemoteUnit::enable_idle_skipping(Duration max_skip) {
  defer([&](wire::Request::Builder request) { request.setEnableIdleSkipping(max_skip.count()); });
}

void RemoteUnit::set_idle_tolerances(References outputs, std::span<const double> tolerances) {
  defer([&](wire::Request::Builder request) {
    auto to = request.initSetIdleTolerances();
    put_references(to.initOutputs(static_cast<unsigned>(outputs.size())), outputs);
    to.setTolerances(to_data(tolerances));
  });
}

Time RemoteUnit::idle_until() {
  Time until = Time::min();
  call(
      "its idle promise", [](wire::Request::Builder request) { request.setGetIdleUntil(); },
      [&](wire::Result::Reader result) { until = to_time(result.getTime()); });
  return until;
}

void RemoteUnit::get_derivatives(References outputs, std::span<double> derivatives) {
  call(
      "derivatives of outputs",
      [&](wire::Request::Builder request) {
        put_references(request.initGetDerivatives(static_cast<unsigned>(outputs.size())), outputs);
      },
      [&](wire::Result::Reader result) { take_doubles(result.getNumbers(), derivatives); });
}

// ---- Messages in words ----

std::string RemoteUnit::describe_message(core::ValueReference variable, const core::Binary& value) {
  std::string text;
  call(
      "the text of a message",
      [&](wire::Request::Builder request) {
        auto asked = request.initDescribeMessage();
        asked.setVariable(variable);
        asked.setValue(to_data(value.data(), value.size()));
      },
      [&](wire::Result::Reader result) { text = to_string(result.getText()); });
  return text;
}

}  // namespace stride::remote
