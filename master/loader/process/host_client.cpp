#include "master/loader/process/host_client.h"

#include <algorithm>

#include <fmt/format.h>

#include "master/base/child_process/process_memory.h"
#include "master/loader/fmu/instance/state_hint.h"
#include "master/loader/process/sandbox_hint.h"
#include "master/loader/process/server.h"

namespace stride::isolation {
namespace {

using namespace std::chrono_literals;

/// How often is looked whether the supervisor is still there.
constexpr std::chrono::milliseconds kProcessCheckInterval{50};

double seconds(std::chrono::milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

MemoryAllowance memory_allowance(const HostedUnitSpec& spec) {
  MemoryAllowance allowance{spec.host.memory_limit, {}};
  if (!allowance.limit) return allowance;
  for (const WritableFolder& folder : writable_folders(spec)) {
    allowance.folders.push_back(folder.path);
  }
  return allowance;
}

/// Of a function, or of what the server does: the unit can write anything there.
bool is_of_name(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' ||
         c == ' ';
}

}  // namespace

HostClient::HostClient(const HostedUnitSpec& spec)
    : spec_(spec),
      process_(link_, memory_allowance(spec),
               [&](pid_t supervisor) { serve(link_, spec, supervisor); }),
      log_(*link_.memory) {}

// ---- To and fro ----

void HostClient::post(RequestCode request, const PacketWriter& packet, std::optional<Time> time) {
  if (has_failed()) [[unlikely]]
    core::fail_run(context(time), "it cannot be called, because " + failure_);
  Turn& turn = link_.memory->request;
  turn.what.store(static_cast<std::uint32_t>(request), std::memory_order_relaxed);
  turn.size.store(packet.size(), std::memory_order_relaxed);
  turn.number.store(++number_, std::memory_order_release);
  turn.doorbell.ring();
}

ReplyCode HostClient::await(std::optional<Time> time,
                            std::optional<std::chrono::milliseconds> limit) {
  if (!waiter_.spin([&] { return has_reply(); })) await_reply(time, limit);
  call_began_.reset();
  if (!log_.is_empty()) [[unlikely]]
    take_lines();
  return static_cast<ReplyCode>(link_.memory->reply.what.load(std::memory_order_relaxed));
}

PacketReader HostClient::read() {
  const std::size_t size = link_.memory->reply.size.load(std::memory_order_relaxed);
  if (!link_.packets.follow(size)) throw BadPacket(kHasOverwritten);
  return PacketReader({link_.packets.data(), size});
}

bool HostClient::has_overwritten_number() const {
  const std::uint32_t reply = link_.memory->reply.number.load(std::memory_order_acquire);
  return link_.memory->request.number != number_ || (reply != number_ && reply != number_ - 1);
}

void HostClient::await_reply(std::optional<Time> time,
                             std::optional<std::chrono::milliseconds> limit) {
  const auto begin = begin_of_call();
  Doorbell& doorbell = link_.memory->reply.doorbell;
  for (;;) {
    const std::uint32_t rings = doorbell.rings();
    take_lines();
    if (has_reply()) return;
    if (has_overwritten_number()) fail_bad_packet(time);
    if (process_.look_for_end()) {
      take_lines();
      if (has_reply()) return;
      fail(process_.how_it_ended() + present_call(), time);
    }
    const auto waited = Clock::now() - begin;
    if (limit && waited >= *limit) {
      const std::string call = present_call();
      process_.kill();
      take_lines();
      fail(fmt::format("it took longer than {} s{}, so its process was ended", seconds(*limit),
                       call),
           time);
    }
    if (is_interrupted_for_long()) fail_interrupted(time);
    if (!limit && waited > spec_.options.warn_after) warn_of_slow_call();
    doorbell.sleep(
        rings, limit ? std::min<std::chrono::nanoseconds>(kProcessCheckInterval, *limit - waited)
                     : kProcessCheckInterval);
  }
}

/// A unit whose messages do not fit waits for this process, at the expense of its time.
HostClient::Clock::time_point HostClient::begin_of_call() {
  const auto now = Clock::now();
  return link_.memory->logged.room() == 0 ? now : call_began_.value_or(now);
}

/// The end of the run waits a little for the call, whose results would be lost.
bool HostClient::is_interrupted_for_long() {
  using namespace std::chrono_literals;
  constexpr auto kPatience = 1s;
  const volatile std::sig_atomic_t* const interrupted = spec_.options.interrupted;
  if (interrupted == nullptr || *interrupted == 0) return false;
  if (!interrupted_at_) interrupted_at_ = Clock::now();
  return Clock::now() - *interrupted_at_ > kPatience;
}

void HostClient::fail_interrupted(std::optional<Time> time) {
  const std::string call = present_call();
  process_.kill();
  take_lines();
  fail(
      fmt::format("the run was interrupted, and this was not done after a second{}, so its process "
                  "was ended; the results up to there are complete",
                  call),
      time);
}

void HostClient::warn_of_slow_call() {
  if (std::exchange(has_slow_call_warning_, true)) return;
  log(importer::Status::Warning, "stride",
      fmt::format("it has taken more than {} s{}, and there is no limit (--unit-timeout)",
                  seconds(spec_.options.warn_after), present_call()));
}

core::HostStatistics HostClient::statistics() const {
  const SnapshotBoard& snapshots = link_.memory->snapshots;
  core::HostStatistics statistics;
  statistics.snapshots = snapshots.snapshots;
  statistics.restores = snapshots.restores;
  statistics.most_snapshots = snapshots.most_kept;
  statistics.most_snapshot_memory = snapshots.most_memory;
  statistics.most_memory = link_.memory->most_memory;
  if (!process_.has_ended()) {
    statistics.most_memory = std::max(statistics.most_memory, most_memory(link_.memory->active));
  }
  return statistics;
}

void HostClient::finish() {
  process_.finish([&] { take_lines(); });
  take_lines();
  take_last_line();
}

// ---- Logged and printed lines ----

void HostClient::take_lines() {
  log_.read([&](LogMessage&& message) {
    if (is_repeating_) return;
    output_tail_.add_logged(message.text);
    log(message.status, message.category, message.text);
  });
  link_.memory->printed.read(printed_.bytes());
  printed_.take([&](std::string_view line) { log_printed(line); });
}

/// What was printed in a call may be there behind its reply only.
void HostClient::set_repeating(bool repeating) {
  if (is_repeating_ && !repeating) take_lines();
  is_repeating_ = repeating;
}

void HostClient::log_printed(std::string_view line) {
  if (is_repeating_) return;
  output_tail_.add_printed(line);
  log(importer::Status::Ok, kPrinted, std::string(line));
}

/// A line without an end, when nothing comes behind it.
void HostClient::take_last_line() {
  printed_.take_rest([&](std::string_view line) { log_printed(line); });
}

void HostClient::log(importer::Status status, const std::string& category,
                     const std::string& text) const noexcept {
  try {
    if (spec_.options.log) spec_.options.log(spec_.name, status, category, text);
  } catch (...) {  // as in the unit's own process, where nothing may cross its C code
  }
}

// ---- Failures ----

void HostClient::fail(const std::string& what, std::optional<Time> time) {
  failure_ = what;
  if (process_.has_ended()) take_last_line();
  std::string hint = process_.hint();
  if (hint.empty()) hint = sandbox_hint(output_tail_.text(), spec_.name, spec_.host);
  if (hint.empty()) hint = importer::state_hint(what, spec_.name);
  if (hint.empty() && spec_.host.memory_limit) {
    hint = fmt::format("its memory is limited to {} MiB (memoryLimit); it may need more",
                       *spec_.host.memory_limit >> 20);
  }
  const std::string text = failure_ + output_tail_.text();
  if (process_.has_lacked_something()) throw core::EnvironmentError(context(time), text, hint);
  core::fail_run(context(time), text, hint);
}

void HostClient::fail_bad_packet(std::optional<Time> time) {
  process_.kill();
  take_lines();
  fail(kHasOverwritten + present_call(), time);
}

std::string HostClient::present_call() const {
  const std::string function(link_.memory->call_note.function());
  if (function.empty()) return "";
  return std::ranges::all_of(function, is_of_name) ? " in " + function : " in an unknown function";
}

/// With the variable whose value was being read, if one was.
core::Context HostClient::context(std::optional<Time> time) const {
  core::Context context{
      .where = spec_.options.where, .unit = spec_.name, .variable = {}, .time = time};
  const auto& own = spec_.options.description;
  const core::UnitDescription& description = own ? *own : *spec_.fmu->description();
  const std::optional<core::ValueReference> read = link_.memory->call_note.variable();
  if (const auto place = read ? description.find(*read) : std::nullopt) {
    context.variable = description.variables[*place].name;
    context.time = link_.memory->call_note.time();  // in a step the end of it
  }
  return context;
}

}  // namespace stride::isolation
