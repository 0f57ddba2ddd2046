#include "tests/fuzz/engine.h"

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <random>
#include <typeinfo>

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/build.h"
#include "tests/fuzz/mutator.h"

namespace stride::tests {
namespace {

/// The inputs of a run, by their numbers.
class Inputs {
 public:
  Inputs(const Parser& parser, unsigned seed)
      : seeds_(seeds_of(parser)), alphabet_(parser.alphabet), seed_(std::mt19937(seed)()) {
    if (seeds_.empty()) throw std::invalid_argument("'" + parser.name + "' has no seeds");
  }

  std::string operator[](std::size_t i) const {
    if (i < seeds_.size()) return seeds_[i];
    Mutator mutator(seed_ + static_cast<unsigned>(i), alphabet_);
    const std::string& text = seeds_[i % seeds_.size()];
    return i / seeds_.size() % 2 == 0 ? mutator.mutate(text) : mutator.replace_quoted(text);
  }

 private:
  std::vector<std::string> seeds_;
  std::string alphabet_;
  unsigned seed_;  // far from that of the next night
};

/// What a worker has done, in memory that outlives it.
struct Progress {
  std::size_t next = 0;
  std::size_t accepted = 0;
  std::size_t refused = 0;
  bool has_finding = false;
  char what[2000] = "";
};

class SharedProgress {
 public:
  SharedProgress()
      : memory_(::mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE,
                       MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    new (memory_) Progress;
  }
  ~SharedProgress() { ::munmap(memory_, sizeof(Progress)); }
  SharedProgress(const SharedProgress&) = delete;
  SharedProgress& operator=(const SharedProgress&) = delete;

  Progress* operator->() const { return static_cast<Progress*>(memory_); }

 private:
  void* memory_;
};

/// In a process of its own: until all is done, or to a finding.
void work(const Parser& parser, const Inputs& inputs, std::size_t count, SharedProgress& progress) {
  const rlimit memory{kMemory, kMemory};
  if (!kSanitized) ::setrlimit(RLIMIT_AS, &memory);
  const rlimit core{0, 0};
  ::setrlimit(RLIMIT_CORE, &core);
  std::string what;
  for (; progress->next < count; ++progress->next) {
    ::alarm(kSecondsPerInput);
    const Answer answer = read_once(parser, inputs[progress->next], what);
    if (answer == Answer::Finding) {
      progress->has_finding = true;
      std::strncpy(progress->what, what.c_str(), sizeof progress->what - 1);
      return;
    }
    ++(answer == Answer::Accepted ? progress->accepted : progress->refused);
  }
}

std::string end_of(int status) {
  if (WIFEXITED(status)) return "exit code " + std::to_string(WEXITSTATUS(status));
  if (WTERMSIG(status) == SIGALRM) {
    return "it took longer than " + std::to_string(kSecondsPerInput) + " s";
  }
  return std::string("signal ") + ::strsignal(WTERMSIG(status));
}

/// Returns how the process ended; empty: well.
std::string run_worker(const Parser& parser, const Inputs& inputs, std::size_t count,
                       SharedProgress& progress) {
  const pid_t worker = ::fork();
  if (worker < 0) throw std::runtime_error("no process can be started");
  if (worker == 0) {
    work(parser, inputs, count, progress);
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(worker, &status, 0);
  return status == 0 ? "" : end_of(status);
}

}  // namespace

Answer read_once(const Parser& parser, const std::string& bytes, std::string& what) {
  try {
    parser.read(bytes);
    return Answer::Accepted;
  } catch (const Refusal& refusal) {
    what = refusal.what();
    return Answer::Refused;
  } catch (const std::exception& error) {
    what = std::string(typeid(error).name()) + ": " + error.what();
  } catch (...) {
    what = "something was thrown that is no std::exception";
  }
  return Answer::Finding;
}

Tally run(const Parser& parser, std::size_t inputs, unsigned seed) {
  const Inputs all(parser, seed);
  SharedProgress progress;
  Tally tally;
  while (progress->next < inputs && tally.findings.size() < kMostFindings) {
    const std::string end = run_worker(parser, all, inputs, progress);
    if (progress->has_finding || !end.empty()) {
      tally.findings.push_back({all[progress->next], end.empty() ? progress->what : end});
      progress->has_finding = false;
      ++progress->next;
    }
  }
  tally.accepted = progress->accepted;
  tally.refused = progress->refused;
  return tally;
}

}  // namespace stride::tests
