// Writes a line for each step that it makes into a file, through the buffer of <cstdio>, as a trace
// is written: what a rolled-back step wrote must not be there. It lists no state.
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include <stride/unit.h>

namespace {

class Tracer : public stride::Unit {
 public:
  Tracer() {
    describe("Writes its steps into a file; rejects those longer than 'longest'").may_reject = true;
    input("u", u_);
    output("lines", lines_).exact().depends_on({}).description("written so far");
    parameter("file", path_).description("that is written; empty: none");
    parameter("flushes", flushes_).description("each line is written at once");
    parameter("longest", longest_).unit("s").min(1e-9);
  }

  void initialize(stride::Time) override {
    if (path_.empty()) return;
    file_.reset(std::fopen(path_.c_str(), "w"));
    if (!file_) throw std::runtime_error("cannot write '" + path_ + "': " + std::strerror(errno));
  }

  void step(stride::Step& step) override {
    if (stride::to_seconds(step.size()) > longest_) return step.reject("this is too long");
    if (file_) {
      std::fprintf(file_.get(), "%.17g %.17g\n", stride::to_seconds(step.to()), u_);
      if (flushes_) std::fflush(file_.get());
    }
    ++lines_;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  double u_ = 0;
  std::int32_t lines_ = 0;
  std::string path_;
  bool flushes_ = false;
  double longest_ = 1;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace

STRIDE_UNIT(Tracer)
