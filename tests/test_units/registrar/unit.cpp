// Leaves an object of its own in a library that is never unloaded.
#include <stride/unit.h>

#include "tests/test_units/registrar/registry.h"

namespace {

struct Own : Listener {
  void hear(const char*) override {}
};

class Registrar : public stride::Unit {
 public:
  Registrar() {
    output("listeners", listeners_).depends_on({});
    static const bool is_first = (register_listener(std::make_shared<Own>()), true);
    static_cast<void>(is_first);
  }
  void step(stride::Step&) override {}

 private:
  std::int32_t listeners_ = 1;
};

}  // namespace

STRIDE_UNIT(Registrar)
