// Fails in the first step that ends at `throw_at` or later.
#include <stdexcept>
#include <string>

#include <stride/unit.h>

namespace {

class Thrower : public stride::Unit {
 public:
  Thrower() {
    parameter("throw_at", throw_at_).unit("s").description("instant from which a step fails");
    parameter("odd", odd_).description("throw something that is not a std::exception");
    parameter("message", message_).description("what is thrown");
    parameter("refuses_states", refuses_states_).description("of instances that have this set");
    output("steps", steps_).exact().depends_on({}).description("steps made");
    state();
  }

  void step(stride::Step& step) override {
    if (stride::to_seconds(step.to()) >= throw_at_) {
      if (odd_) throw 42;
      throw std::runtime_error(message_);
    }
    ++steps_;
  }

  void load_state(stride::StateReader&) override {
    if (refuses_states_) throw std::runtime_error("it takes no state like this");
  }

 private:
  double throw_at_ = 0;
  bool refuses_states_ = false;
  bool odd_ = false;
  std::string message_ = "the fuse has blown";
  std::int32_t steps_ = 0;
};

}  // namespace

STRIDE_UNIT(Thrower)
