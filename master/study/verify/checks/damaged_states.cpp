#include "master/study/verify/checks/damaged_states.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/study/verify/recording.h"

namespace stride::verify {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kFlips = 4;        ///< in processes of their own
constexpr std::size_t kMoreFlips = 256;  ///< in one

/// One of `count` bits that are spread over all bytes.
DamagedState flipped(const Bytes& bytes, std::size_t i, std::size_t count) {
  DamagedState damaged{"bytes with a flipped bit", bytes};
  damaged.bytes[bytes.size() * i / count] ^= static_cast<std::uint8_t>(1U << (i % 8));
  return damaged;
}

bool is_refused(TestInstance& instance, const Bytes& bytes) {
  try {
    instance.capability<core::StateSerialization>().deserialize_state(bytes);
    return false;
  } catch (const core::Error&) {
    instance.reset();
    return true;
  }
}

std::string reaction(const Trial& trial, const Bytes& bytes) {
  try {
    return trial.in_child([&] {
      TestInstance instance = trial.make_instance();
      try {
        instance.capability<core::StateSerialization>().deserialize_state(bytes);
        instance.capability<core::StateSaving>().restore_state();
        return std::string("accepted");
      } catch (const core::Error&) {
        return std::string("refused");
      }
    });
  } catch (const Failure& failure) {
    return failure.what();
  }
}

}  // namespace

std::vector<DamagedState> damaged_states(const Bytes& bytes) {
  Bytes longer = bytes;
  longer.insert(longer.end(), 64, 0xFF);
  Bytes other(bytes.size());
  for (std::size_t i = 0; i < other.size(); ++i) other[i] = static_cast<std::uint8_t>(151 * i + 7);
  std::vector<DamagedState> damaged{
      {"bytes that break off",
       Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2))},
      {"no bytes at all", {}},
      {"bytes with something behind them", std::move(longer)},
      {"bytes of something else", std::move(other)}};
  for (std::size_t i = 0; i < kFlips && !bytes.empty(); ++i) {
    damaged.push_back(flipped(bytes, i, kFlips));
  }
  return damaged;
}

std::vector<std::string> accepted_states(const Trial& trial,
                                         const std::vector<DamagedState>& damaged) {
  std::vector<std::string> accepted;
  for (const DamagedState& state : damaged) {
    const std::string seen = reaction(trial, state.bytes);
    const std::string line = fmt::format("{}: {}", state.what, seen);
    const bool is_known = std::ranges::find(accepted, line) != accepted.end();
    if (seen != "refused" && !is_known) accepted.push_back(line);
  }
  return accepted;
}

void require_refusals(const Trial& trial, const SerializedRun& run,
                      const std::vector<DamagedState>& damaged) {
  const SerializedState& state = run.states.front();
  std::vector<DamagedState> all = damaged;
  for (std::size_t i = 0; i < kMoreFlips; ++i) all.push_back(flipped(state.bytes, i, kMoreFlips));
  const std::string differs = trial.in_child([&] {
    TestInstance instance = trial.make_instance();
    for (const DamagedState& bad : all) {
      if (!is_refused(instance, bad.bytes)) return fmt::format("{}: accepted", bad.what);
    }
    restore(trial, instance, state);
    finish_from(instance, state, run.to);
    return difference(trial.tested, run.rows_after(state), instance.recording().rows,
                      "in the instance that was serialised",
                      "in one that has refused damaged bytes before")
        .value_or("");
  });
  if (!differs.empty()) throw Failure(differs, false);
}

}  // namespace stride::verify
