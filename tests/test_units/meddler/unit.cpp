// Changes what all code in its process shares, and leaves it so. The environment variable
// STRIDE_MEDDLE says when and what: "step folder,rounding". Its numbers depend on rounding and on
// subnormal numbers themselves.
#include <cfenv>
#include <clocale>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <locale>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <stride/unit.h>

namespace {

/// Writes 1234.5 as 1.234,5.
struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

void change_locale() {
  std::locale::global(std::locale(std::locale(), new Comma));
  std::setlocale(LC_ALL, "C.UTF-8");
}

void block_interrupts() {
  std::signal(SIGINT, SIG_IGN);
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGINT);
  ::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

void lower_limit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = 8;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

void flush_to_zero() {
#if defined(__x86_64__)
  __builtin_ia32_ldmxcsr(__builtin_ia32_stmxcsr() | 0x8040);
#elif defined(__aarch64__)
  asm volatile("msr fpcr, %0" : : "r"(std::uint64_t{1} << 24));
#endif
}

/// So that the next long double is NaN.
void use_registers() {
#if defined(__x86_64__)
  asm volatile("fld1; fld1; fld1; fld1; fld1; fld1; fld1; fld1");
#endif
}

/// Into a buffer of this library.
void take_streams() {
  struct Buffer : std::streambuf {
    int sync() override { throw std::runtime_error("the buffer of the unit"); }
  };
  static Buffer buffer;
  for (std::ostream* const stream : {&std::cout, &std::cerr, &std::clog}) {
    stream->rdbuf(&buffer);
    stream->exceptions(std::ios::badbit | std::ios::failbit);
  }
}

void meddle(const std::string& what) {
  static const std::map<std::string, std::function<void()>> kWays{
      {"folder", [] { static_cast<void>(!::chdir("/")); }},
      {"mask", [] { ::umask(0777); }},
      {"variable", [] { ::setenv("TMPDIR", "/nowhere", 1); }},
      {"new variable", [] { ::setenv("STRIDE_MEDDLED", "yes", 1); }},
      {"locale", change_locale},
      {"interrupts", block_interrupts},
      {"crashes", [] { std::signal(SIGSEGV, SIG_DFL); }},
      {"handled crashes", [] { std::signal(SIGSEGV, [](int) { ::_exit(9); }); }},
      {"limit", lower_limit},
      {"rounding", [] { std::fesetround(FE_UPWARD); }},
      {"flush", flush_to_zero},
      {"exceptions", [] { ::feenableexcept(FE_DIVBYZERO); }},
      {"registers", use_registers},
      {"streams", take_streams},
      {"crash", [] { std::abort(); }},
      {"fork", [] { ::fork(); }},
  };
  kWays.at(what)();
}

void act(const std::string& phase) {
  const char* const wish = std::getenv("STRIDE_MEDDLE");
  if (wish == nullptr) return;
  const std::string text = wish;
  if (text.substr(0, text.find(' ')) != phase) return;
  std::istringstream ways(text.substr(phase.size() + 1));
  for (std::string way; std::getline(ways, way, ',');) meddle(way);
}

[[gnu::constructor(65535)]] void when_loaded() { act("load"); }

class Meddler : public stride::Unit {
 public:
  Meddler() {
    describe("Changes what all code in its process shares");
    input("u", u_).intermediate();
    output("seen", seen_).exact().depends_on({}).description("the last input within a step");
    output("sum", sum_).exact().depends_on({});
    output("tiny", tiny_).exact().depends_on({});
    state();
    act("instantiate");
  }

  void initialize(stride::Time) override { act("initialize"); }
  void step(stride::Step& step) override {
    update_inputs_in_own_mode(step);
    seen_ = u_;
    sum_ += (u_ + 0.1) * stride::to_seconds(step.size());
    tiny_ = static_cast<double>(static_cast<long double>(sum_) * 1e-310L);
    act("step");
  }
  void event(stride::Event&) override { act("event"); }
  void terminate() override { act("terminate"); }

 private:
  /// What it may do: the mode is put back before it returns.
  static void update_inputs_in_own_mode(const stride::Step& step) {
    act("within");
    const int rounding = std::fegetround();
    step.update_inputs(stride::to_seconds(step.size()) / 4);
    if (std::fegetround() != rounding) throw std::runtime_error("the mode has not come back");
    std::fesetround(FE_TONEAREST);
  }

  double u_ = 0;
  double seen_ = 0;
  double sum_ = 0;
  double tiny_ = 0;
};

}  // namespace

STRIDE_UNIT(Meddler)
