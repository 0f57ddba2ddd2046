// Harms its process, or those around it, in the first call of a kind that comes at `at` or later.
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include <dlfcn.h>

#include <stride/unit.h>

#include "tests/test_units/faults/faults.h"

namespace {

/// Until the process ends.
void keep_library() {
  Dl_info self{};
  if (::dladdr(reinterpret_cast<void*>(&keep_library), &self) == 0 ||
      ::dlopen(self.dli_fname, RTLD_NOW | RTLD_NOLOAD | RTLD_NODELETE) == nullptr) {
    throw std::runtime_error("the library cannot be kept");
  }
}

/// Acts when the library is unloaded.
struct Unloading {
  std::string fault;
  ~Unloading() {
    if (!fault.empty()) stride::tests::commit_fault(fault);
  }
} unloading;

class Faulty : public stride::Unit {
 public:
  explicit Faulty(const stride::Setup& setup) {
    describe("Harms its process, or those around it");
    input("u", u_);
    output("y", y_).exact().depends_on({});
    parameter("fault", fault_).description("what it does: " + stride::tests::fault_names());
    parameter("call", call_)
        .description("in which call: initialize, step, event, terminate, free, unload or exit");
    parameter("at", at_).unit("s").tunable().description(
        "the first end of a step at which it does so");
    parameter("file", file_).description("a file that it writes instead");
    state(has_acted_);
    if (setup.instance_name == "dies_at_birth") std::abort();
    if (setup.instance_name == "dozes_at_birth") stride::tests::commit_fault("doze");
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
  void act(const std::string& call, stride::Time now) {
    if (call != call_ || now < stride::time_from_seconds(at_) || has_acted_) return;
    has_acted_ = true;
    if (!file_.empty()) write_file();
    if (fault_.empty()) return;
    stride::tests::commit_fault(fault_);
  }

  void write_file() const {
    std::FILE* const file = std::fopen(file_.c_str(), "w");
    if (file == nullptr) {
      throw std::runtime_error("cannot write " + file_ + ": " + std::strerror(errno));
    }
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
