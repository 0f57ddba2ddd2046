#include <cstdlib>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <sys/mman.h>

#include "master/verify/checks.h"

namespace stride::verify {
namespace {

/// Fills the stack below with a pattern, so that a variable without a value has another one.
[[gnu::noinline]] void soil_stack() {
  volatile unsigned char bytes[256 * 1024];
  for (volatile unsigned char& byte : bytes) byte = 0xA5;
}

/// Makes this process unlike its sisters: fresh memory is not zero, and libraries and heap blocks
/// stand at other addresses.
void disturb() {
  constexpr int kPattern = 0x5A;
  constexpr std::size_t kShift = 97 << 12;
  ::mallopt(M_PERTURB, kPattern);
  ::mmap(nullptr, kShift, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  static std::vector<std::vector<char>> blocks;  // they stay
  for (std::size_t size = 16; size < 100'000; size += size / 3) blocks.emplace_back(size, 'x');
  ::setenv("STRIDE_VERIFY_DISTURBED", "an environment of another length", 1);
  soil_stack();
}

}  // namespace

Finding check_determinism(const Trial& trial) {
  const Subject& subject = trial.subject;
  const Recording first = trial.record();
  const Recording second = recording_from_text(trial.in_child([&] {
    disturb();
    Life life = trial.live();
    life.start();
    life.run_to(subject.steps());
    return to_text(life.recording());
  }));
  const auto differs = difference(subject, first.rows, second.rows, "in one process",
                                  "in another, whose memory is not zero and stands elsewhere");
  if (differs) return failed(*differs);
  return passed(fmt::format("two processes, {} values at {} instants", subject.observed_count(),
                            first.rows.size()));
}

}  // namespace stride::verify
