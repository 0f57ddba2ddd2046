// Harms its process, or those around it, in the first call of a kind that comes at `at` or later.
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <dlfcn.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stride/unit.h>

namespace {

[[noreturn]] void sleep_for_ever() {
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error(what + ": " + std::strerror(errno));
}

void write_to_nowhere() {
  int* volatile nowhere = reinterpret_cast<int*>(16);
  *nowhere = 1;
}

void abort_aloud() {
  std::fputs("the model is inconsistent\n", stderr);
  std::abort();
}

void exit_in_thread() {
  std::thread([] { std::exit(5); }).join();
}

void throw_in_thread() {
  std::thread([] { throw std::runtime_error("nobody catches this"); }).join();
}

/// Deeper than any stack; the frames are looked at, so none is left out.
int recurse(int depth, volatile char* above) {
  volatile char frame[4096];
  frame[0] = *above;
  return depth == 0 ? 0 : recurse(depth - 1, frame) + frame[0];
}

void overflow_the_stack() {
  volatile char first = 0;
  recurse(1 << 30, &first);
}

[[noreturn]] void loop() {
  for (volatile unsigned i = 0;; i = i + 1) {
  }
}

void allocate() {
  std::vector<std::vector<char>> pieces;
  for (;;) pieces.emplace_back(std::size_t{1} << 20, 'x');
}

/// Of memory that the limit of a process does not cover, so that a machine without any other limit
/// bears it.
constexpr int kPieces = 512;
constexpr std::size_t kPiece = std::size_t{1} << 20;

[[noreturn]] void allocate_shared() {
  for (int i = 0; i < kPieces; ++i) {
    void* const piece =
        ::mmap(nullptr, kPiece, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (piece == MAP_FAILED) fail("mmap");
    std::memset(piece, 'x', kPiece);
  }
  sleep_for_ever();
}

void write_pieces(int file) {
  const std::string piece(kPiece, 'x');
  for (int i = 0; i < kPieces; ++i) {
    if (::write(file, piece.data(), kPiece) != static_cast<ssize_t>(kPiece)) fail("write");
  }
}

[[noreturn]] void write_nameless_file() {
  write_pieces(::memfd_create("pieces", 0));
  sleep_for_ever();
}

[[noreturn]] void write_temporary_file() {
  const std::string name = std::string(std::getenv("TMPDIR")) + "/pieces";
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT, 0600);
  if (file < 0) fail(name);
  write_pieces(file);
  ::close(file);
  sleep_for_ever();
}

/// Each of them within its limit.
[[noreturn]] void allocate_in_children() {
  for (int i = 0; i < 8; ++i) {
    if (::fork() != 0) continue;
    const std::string pieces(32 * kPiece, 'x');
    sleep_for_ever();
  }
  sleep_for_ever();
}

/// Says so by a file, and goes on as if nothing was.
void doze() {
  if (const char* const results = std::getenv("STRIDE_RESULTS")) {
    std::ofstream(std::string(results) + "/dozes") << "now";
  }
  std::this_thread::sleep_for(std::chrono::seconds(1));
}

/// A megabyte, and goes on as if nothing was.
void print() {
  for (int i = 0; i < 16384; ++i) std::printf("line %5d: %s\n", i, std::string(50, '.').c_str());
  std::fflush(stdout);
}

void close_all_files() {
  for (int file = 0; file < 1024; ++file) ::close(file);
}

void kill_parent() {
  if (::kill(::getppid(), SIGKILL) != 0) fail("cannot kill the parent");
}

/// Leaves its group and its parent, as a service does.
void start_daemon() {
  if (::fork() == 0) {
    ::setsid();
    if (::fork() == 0) sleep_for_ever();
    ::_exit(0);
  }
}

/// Another process goes on printing what it has begun.
void die_while_another_prints() {
  if (::fork() == 0) {
    for (;;) print();
  }
  write_to_nowhere();
}

/// What it shares with other processes, whatever that is.
void overwrite_shared_memory() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    unsigned long begin = 0, end = 0;
    char mode[5] = "";
    if (std::sscanf(line.c_str(), "%lx-%lx %4s", &begin, &end, mode) != 3) continue;
    if (std::string(mode) != "rw-s") continue;
    std::memset(reinterpret_cast<void*>(begin), 0xee, end - begin);
  }
}

void write_temporary() {
  std::string name = std::string(std::getenv("TMPDIR")) + "/notes-XXXXXX";
  const int file = ::mkstemp(name.data());
  if (file < 0) fail("cannot make " + name);
  ::close(file);
}

void connect() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  if (socket < 0) fail("cannot make a socket");
  ::close(socket);
}

const std::map<std::string, std::function<void()>> kFaults{
    {"segfault", write_to_nowhere},
    {"abort", abort_aloud},
    {"exit", [] { std::exit(3); }},
    {"exit with 0", [] { std::exit(0); }},
    {"_exit", [] { ::_exit(4); }},
    {"exit in a thread", exit_in_thread},
    {"throw in a thread", throw_in_thread},
    {"stack overflow", overflow_the_stack},
    {"loop", loop},
    {"stop", [] { std::raise(SIGSTOP); }},
    {"kill", [] { std::raise(SIGKILL); }},
    {"kill parent", kill_parent},
    {"allocate", allocate},
    {"print", print},
    {"print for ever",
     [] {
       for (;;) print();
     }},
    {"close files", close_all_files},
    {"daemon", start_daemon},
    {"die while another prints", die_while_another_prints},
    {"doze", doze},
    {"allocate shared", allocate_shared},
    {"allocate in children", allocate_in_children},
    {"write nameless file", write_nameless_file},
    {"write temporary file", write_temporary_file},
    {"overwrite", overwrite_shared_memory},
    {"connect", connect},
    {"write temporary", write_temporary},
};

/// Until the process ends.
void keep_library() {
  Dl_info self{};
  if (::dladdr(reinterpret_cast<void*>(&keep_library), &self) == 0) fail("dladdr");
  if (::dlopen(self.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE) == nullptr) fail("dlopen");
}

/// Acts when the library is unloaded.
struct Unloading {
  std::string fault;
  ~Unloading() {
    if (!fault.empty()) kFaults.at(fault)();
  }
} unloading;

class Faulty : public stride::Unit {
 public:
  explicit Faulty(const stride::Setup& setup) {
    describe("Harms its process, or those around it");
    input("u", u_);
    output("y", y_).exact().depends_on({});
    parameter("fault", fault_).description("what it does: " + names());
    parameter("call", call_)
        .description("in which call: initialize, step, event, terminate, free, unload or exit");
    parameter("at", at_).unit("s").description("the first end of a step at which it does so");
    parameter("file", file_).description("a file that it writes instead");
    state(has_acted_);
    if (setup.instance_name == "dies_at_birth") std::abort();
    if (setup.instance_name == "dozes_at_birth") doze();
  }
  ~Faulty() override {
    if (call_ == "unload" || call_ == "exit") unloading.fault = fault_;
    if (call_ == "exit") keep_library();
    act("free", stride::Time::max());
  }

  void initialize(stride::Time) override {
    has_acted_ = false;
    act("initialize", stride::Time::max());
  }
  void step(stride::Step& step) override {
    y_ += u_ * stride::to_seconds(step.size());
    act("step", step.to());
  }
  void event(stride::Event& event) override { act("event", event.time()); }
  void terminate() override { act("terminate", stride::Time::max()); }

 private:
  static std::string names() {
    std::string names;
    for (const auto& [name, fault] : kFaults) names += (names.empty() ? "" : ", ") + name;
    return names;
  }

  void act(const std::string& call, stride::Time now) {
    if (call != call_ || now < stride::time_from_seconds(at_) || has_acted_) return;
    has_acted_ = true;
    if (!file_.empty()) write_file();
    if (fault_.empty()) return;
    std::fprintf(stderr, "now comes: %s\n", fault_.c_str());
    kFaults.at(fault_)();
  }

  void write_file() const {
    std::FILE* const file = std::fopen(file_.c_str(), "w");
    if (file == nullptr) fail("cannot write " + file_);
    std::fputs("written\n", file);
    std::fclose(file);
  }

  double u_ = 1;
  double y_ = 0;
  std::string fault_;
  std::string call_ = "step";
  double at_ = 0;
  std::string file_;
  bool has_acted_ = false;
};

}  // namespace

STRIDE_UNIT(Faulty)
