// Verifies a single unit.
#ifndef STRIDE_MASTER_STUDY_VERIFY_VERIFY_H
#define STRIDE_MASTER_STUDY_VERIFY_VERIFY_H

#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include "master/study/verify/finding.h"
#include "master/study/verify/tested_unit.h"

namespace stride::verify {

struct Result {
  std::string check;
  Finding finding;
  double seconds = 0;  ///< of wall-clock time
};

struct Hooks {
  std::function<void(const char* check)> on_begin = [](const char*) {};
  /// Set by a signal handler to end the run: verify() then throws core::Error (Run).
  const volatile std::sig_atomic_t* interrupted = nullptr;
};

/// Runs the checks that are asked for, in their order, each in a process of its own, so whatever
/// the unit does is a verdict. Where the first one, `load`, fails, the others are skipped. Throws
/// core::Error: Input for the name of a check that there is not.
std::vector<Result> verify(const TestedUnit& tested, const Hooks& hooks = {});

bool all_good(const std::vector<Result>& results);

/// The results as JSON, as docs/verify.md describes them.
std::string json_text(const TestedUnit& tested, const std::vector<Result>& results);

}  // namespace stride::verify

#endif
