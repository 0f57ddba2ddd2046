// Many scalar inputs and outputs, and next to nothing to compute: for benchmarks of the exchange.
#include <array>
#include <cstddef>
#include <string>

#include <stride/unit.h>

namespace {

class Wide : public stride::Unit {
 public:
  Wide() {
    describe("A hundred outputs, each of which follows the input of the same number");
    for (std::size_t i = 0; i < kWidth; ++i) {
      const std::string index = "[" + std::to_string(i + 1) + "]";
      input("u" + index, u_[i]);
      output("y" + index, y_[i]).exact().depends_on({});
      y_[i] = static_cast<double>(i);
    }
    state();
  }

  void step(stride::Step&) override {
    for (std::size_t i = 0; i < kWidth; ++i) y_[i] = 0.5 * (y_[i] + u_[i]);
  }

 private:
  static constexpr std::size_t kWidth = 100;
  std::array<double, kWidth> u_{};
  std::array<double, kWidth> y_{};
};

}  // namespace

STRIDE_UNIT(Wide)
