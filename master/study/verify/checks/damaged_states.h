// What a unit makes of bytes that are not a state of it.
#ifndef STRIDE_MASTER_STUDY_VERIFY_CHECKS_DAMAGED_STATES_H
#define STRIDE_MASTER_STUDY_VERIFY_CHECKS_DAMAGED_STATES_H

#include <cstdint>
#include <string>
#include <vector>

#include "master/study/verify/checks.h"
#include "master/study/verify/checks/serialized_run.h"

namespace stride::verify {

struct DamagedState {
  std::string what;
  std::vector<std::uint8_t> bytes;
};

/// Truncated, extended, with a flipped bit, and what could be the state of another unit.
std::vector<DamagedState> damaged_states(const std::vector<std::uint8_t>& bytes);

/// What the unit does with them, each in a process of its own: a line for each kind that it does
/// not refuse. The standards require nothing of it here.
std::vector<std::string> accepted_states(const Trial& trial,
                                         const std::vector<DamagedState>& damaged);

/// For a unit of stride's kit, which refuses each of them, and any flipped bit: an instance that
/// has refused them all, with a reset after each, goes on from the state itself. Throws Failure
/// otherwise.
void require_refusals(const Trial& trial, const SerializedRun& run,
                      const std::vector<DamagedState>& damaged);

}  // namespace stride::verify

#endif
