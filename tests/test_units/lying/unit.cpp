// A unit that does not keep what it declares. The macro LIE says what is wrong with it; a copy of
// the source is built for each. But for the lie it is a low-pass of first order that counts.
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>

#include <stride/unit.h>

/// Of the leak sanitizer, where the program has one.
extern "C" [[gnu::weak]] void __lsan_ignore_object(const void*);

namespace {

enum Lie {
  None,
  ForgetsOnRestore,   ///< a variable of its state is not saved
  DependsOnSplit,     ///< an explicit Euler step, though it declares split_invariant
  Leaks,              ///< memory, with each instance
  LeaksPages,         ///< likewise, which it did not get from malloc()
  LeaksFiles,         ///< files, likewise
  GrowsInSteps,       ///< memory, with each step
  SharesState,        ///< with all instances of its process
  CrashesInReset,     ///< when it is made again in its process
  HangsInStep,        ///< from 0.02 s on
  HiddenDependency,   ///< an output follows an input that it is declared not to depend on
  KeepsInputInReset,  ///< has the input of its last step instead of the start value
  ForgetsInReset,     ///< its count goes on where it was
  IgnoresStart,       ///< an output's start value is not what the unit has
  LeavesRange,        ///< an output goes above its max
  NotDeterministic,   ///< it takes an address for a number
  BreaksRejection,    ///< it rejects a step after it has made half of it
  AnnouncesPast,      ///< its next event is over
  IteratesForEver,    ///< its events do not end
  ExitsInStep,        ///< it ends the process
  MumblesMessages,    ///< its descriptions of messages are not text
  CountsQuestions,    ///< it changes when a message is described
  CountsRepetitions,  ///< each third step ends early, those included that are made again
  ForgetsEvents,      ///< what an event leaves for the next step is not saved
  SavesAddress,       ///< its state has a pointer in it
  OnlyOnce,           ///< no lie: it says that it crashes when it is made again in its process
};
constexpr Lie kLie = LIE;

/// What all instances of a process share, and must not.
int shared_count = 0;
double shared_input = 0;
bool was_initialized = false;
void* volatile lost = nullptr;

/// Not for a process that only packs the unit.
void leak() {
  lost = std::malloc(100);
  if (__lsan_ignore_object != nullptr) __lsan_ignore_object(lost);
}

void leak_pages() {
  constexpr std::size_t kBytes = 8192;
  lost = ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE,
                -1, 0);
}

class Lying : public stride::Unit {
 public:
  Lying() {
    auto& info = describe("Does not keep what it declares");
    info.may_reject = kLie == BreaksRejection;
    info.single_instance = kLie == OnlyOnce;
    info.split_invariant = kLie == DependsOnSplit;
    info.early_return = kLie == CountsRepetitions;
    input("u", u_);
    output("y", y_).exact().depends_on({}).range(-10, kLie == LeavesRange ? 0.01 : 10);
    output("steps", steps_).exact().depends_on({});
    output("echo", echo_).exact().depends_on({});
    if (kLie == ForgetsOnRestore) {
      state(hidden_);
    } else {
      state(hidden_, count_);
    }
    if (kLie == SavesAddress) state(address_);
    if (kLie == MumblesMessages || kLie == CountsQuestions) output("message", message_);
    if ((kLie == CrashesInReset || kLie == OnlyOnce) && was_initialized) std::raise(SIGSEGV);
    if (kLie == ForgetsInReset && was_initialized) count_ = shared_count;
    if (kLie == KeepsInputInReset) u_ = shared_input;
    if (kLie == Leaks) leak();
    if (kLie == LeaksPages) leak_pages();
    if (kLie == LeaksFiles) ::open("/dev/null", O_RDONLY);
  }

  void initialize(stride::Time) override {
    if (kLie == IgnoresStart) y_ = 0.25;
    was_initialized = true;
  }

  void step(stride::Step& step) override {
    if (kLie == HangsInStep && step.to() > stride::Time(std::chrono::milliseconds(20))) {
      for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    if (kLie == ExitsInStep) std::exit(3);
    const double h = stride::to_seconds(step.size());
    if (kLie == BreaksRejection && h > 0.003) {
      y_ += h / 2 * (u_ - y_);
      return step.reject("too long");
    }
    if (kLie == CountsRepetitions && ++steps_made_ % 3 == 0) {
      return step.return_early(step.from() + step.size() / 2);
    }
    if (kLie == GrowsInSteps) grown_.push_back(std::vector<char>(100));
    y_ += h / 0.05 * (u_ - y_);
    if (std::exchange(is_after_event_, false)) y_ += 1e-3;
    ++count_;
    ++shared_count;
    shared_input = u_;
    if (kLie != DependsOnSplit)
      steps_ = kLie == SharesState || kLie == CountsQuestions ? shared_count : count_;
    if (kLie == NotDeterministic) {
      echo_ = static_cast<double>(reinterpret_cast<std::uintptr_t>(this));
    }
  }

  void update_outputs() override {
    if (kLie == HiddenDependency) echo_ = 2 * u_;
  }

  std::string describe_message(const stride::Variable&, const stride::Binary&) const override {
    if (kLie == CountsQuestions) ++shared_count;
    return kLie == MumblesMessages ? "\xFFmm" : "a message";
  }

  void event(stride::Event& event) override {
    if (kLie == AnnouncesPast && event.time() > stride::Time(std::chrono::milliseconds(30))) {
      event.next_event(event.time() - std::chrono::milliseconds(20));
    }
    if (kLie == IteratesForEver) event.iterate();
    if (kLie == ForgetsEvents) is_after_event_ = event.time() > stride::Time{};
  }

 private:
  double u_ = 0;
  double y_ = 0;
  std::int32_t steps_ = 0;
  double echo_ = 0;
  std::int32_t count_ = 0;
  int steps_made_ = 0;
  bool is_after_event_ = false;
  struct {
    const void* self;
  } address_{this};
  double hidden_ = 0;
  stride::Binary message_;
  std::vector<std::vector<char>> grown_;
};

}  // namespace

STRIDE_UNIT(Lying)
