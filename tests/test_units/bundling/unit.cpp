// Gets its output from a shared library of its own.
#include <stride/unit.h>

extern "C" int stride_test_answer(void);

namespace {

class Bundling : public stride::Unit {
 public:
  Bundling() { output("answer", answer_).depends_on({}); }
  void initialize(stride::Time) override { answer_ = stride_test_answer(); }
  void step(stride::Step&) override {}

 private:
  std::int32_t answer_ = 0;
};

}  // namespace

STRIDE_UNIT(Bundling)
