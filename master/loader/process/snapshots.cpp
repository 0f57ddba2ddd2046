#include "master/loader/process/snapshots.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "master/base/child_process/process_memory.h"
#include "master/base/child_process/sibling.h"
#include "master/base/child_process/surroundings.h"

namespace stride::isolation {
namespace {

using State = SnapshotBoard::State;

/// A measurement goes through all pages of a process: it may take this share of the time.
constexpr int kMeasuredShare = 100;
/// For how long a snapshot sleeps, if it is not woken.
constexpr std::chrono::hours kAWhile{1};

State wait_while_frozen(SnapshotBoard::Entry& entry) {
  for (;;) {
    const std::uint32_t rings = entry.doorbell.rings();
    if (const State state = entry.state; state != State::Frozen) return state;
    entry.doorbell.sleep(rings, kAWhile);
  }
}

}  // namespace

void SnapshotBoard::note_end(pid_t process) {
  for (Entry& entry : entries) {
    if (entry.process != process) continue;
    entry.state = entry.state == State::Frozen ? State::Lost : State::Free;
  }
}

Snapshots::Snapshots(SnapshotBoard& board, std::atomic<pid_t>& active, pid_t supervisor,
                     SnapshotOptions options)
    : board_(board),
      active_(active),
      supervisor_(supervisor),
      options_(std::move(options)),
      files_(options_.own_files) {}

bool Snapshots::save(std::size_t slot, std::optional<Time> time) {
  options_.context.time = time;
  check(slot);
  refuse_company();
  const std::uint32_t number = find_free_entry();
  Entry& entry = board_.entries[number];
  pid_t process = 0;
  try {
    files_.note();
    entry.memory = 0;
    entry.process = 0;
    entry.state = State::Frozen;
    process = fork_sibling();
  } catch (const std::exception& failure) {
    entry.state = State::Free;
    fail(fmt::format("its process cannot be saved: {}", failure.what()));
  }
  if (process == 0) return freeze(entry);
  entry.process = process;
  measure_sometimes();
  discard(slot);
  board_.entry_of[slot] = number + 1;
  count();
  return false;
}

void Snapshots::restore(std::size_t slot, std::optional<Time> time) {
  options_.context.time = time;
  check(slot);
  const std::uint32_t number = board_.entry_of[slot];
  if (number == 0) fail(fmt::format("it is to be restored, but nothing was saved ({})", slot));
  Entry& entry = board_.entries[number - 1];
  active_ = entry.process.load();
  State expected = State::Frozen;
  if (!entry.state.compare_exchange_strong(expected, State::TakesOver)) {
    active_ = ::getpid();
    fail("the snapshot of its process that is to be restored has been ended by something",
         "look whether the machine was short of memory");
  }
  entry.doorbell.ring();
  ::_exit(0);
}

/// In the snapshot: sleeps until its state changes.
bool Snapshots::freeze(Entry& entry) {
  end_with(supervisor_);
  entry.process = ::getpid();
  for (;;) {
    if (wait_while_frozen(entry) == State::Ends) ::_exit(0);
    entry.state = State::Frozen;
    pid_t process = 0;
    try {
      process = fork_sibling();
    } catch (const std::system_error& failure) {
      entry.state = State::Lost;  // it is the active process itself now
      fail(fmt::format("its process cannot be restored: {}", failure.what()));
    }
    if (process == 0) return take_over();
  }
}

bool Snapshots::take_over() {
  end_with(supervisor_);
  active_ = ::getpid();
  ++board_.restores;
  try {
    files_.set_back();
  } catch (const std::exception& failure) {
    fail(fmt::format("its process cannot be restored: {}", failure.what()));
  }
  return true;
}

void Snapshots::discard(std::size_t slot) {
  const std::uint32_t number = board_.entry_of[slot].exchange(0);
  if (number == 0) return;
  Entry& entry = board_.entries[number - 1];
  State expected = State::Frozen;
  if (entry.state.compare_exchange_strong(expected, State::Ends)) {
    entry.doorbell.ring();
  } else {
    entry.state = State::Free;
  }
}

void Snapshots::check(std::size_t slot) const {
  if (slot < SnapshotBoard::kSlots) return;
  fail(
      fmt::format("{} states of it are to be kept, and there are {} snapshots of a process at most",
                  slot + 1, SnapshotBoard::kSlots));
}

/// What a fork would leave behind.
void Snapshots::refuse_company() const {
  const std::string hint =
      "use a unit that can save its state (canGetAndSetFMUState); with the policy "
      "'error-controlled', use 'fixed' or 'event-driven'; with others, <stride:Host "
      "components=\"…\" snapshots=\"false\"/> leaves it without snapshots, if no step of it has "
      "to be repeated";
  if (const std::size_t threads = thread_count(); threads > 1) {
    fail(fmt::format("the unit runs {} threads, and a snapshot of its process holds one only",
                     threads),
         "let it run on one thread (with OpenMP: OMP_NUM_THREADS=1), or " + hint);
  }
  if (has_children()) {
    fail("the unit has started another process, which a snapshot of its own does not hold", hint);
  }
}

/// Snapshots that were ordered to end do so at once, and the supervisor sees it, so one is found
/// soon.
std::uint32_t Snapshots::find_free_entry() {
  for (;;) {
    for (std::uint32_t i = 0; i < board_.entries.size(); ++i) {
      if (board_.entries[i].state == State::Free) return i;
    }
    ::usleep(100);
  }
}

void Snapshots::count() {
  ++board_.snapshots;
  const auto kept = std::count_if(board_.entry_of.begin(), board_.entry_of.end(),
                                  [](const auto& entry) { return entry != 0; });
  raise_to(board_.most_kept, static_cast<std::uint64_t>(kept));
}

void Snapshots::measure_sometimes() {
  const auto began = Clock::now();
  if (began < next_measurement_) return;
  measure();
  const auto end = Clock::now();
  next_measurement_ = end + kMeasuredShare * (end - began);
}

void Snapshots::measure() {
  std::uint64_t sum = 0;
  for (const auto& number : board_.entry_of) {
    if (number == 0) continue;
    Entry& entry = board_.entries[number - 1];
    if (entry.state == State::Frozen) entry.memory = private_memory(entry.process);
    sum += entry.memory;
  }
  raise_to(board_.most_memory, sum);
  if (!options_.memory_limit || sum <= *options_.memory_limit) return;
  fail(fmt::format("the snapshots of its process have {} MiB to themselves, more than its limit of "
                   "{} MiB",
                   sum >> 20, *options_.memory_limit >> 20),
       "raise the limit (memoryLimit), or use a unit that can save its state "
       "(canGetAndSetFMUState)");
}

void Snapshots::fail(const std::string& message, const std::string& hint) const {
  core::fail_run(options_.context, message, hint);
}

}  // namespace stride::isolation
