#include "master/study/search/shrink.h"

#include <utility>

namespace stride::search {
namespace {

class Shrinking {
 public:
  Shrinking(const std::vector<bool>& is_continuous, double tolerance,
            const std::function<bool(const Shares&)>& fails)
      : is_continuous_(is_continuous), tolerance_(tolerance), fails_(fails) {
    shrunk_.failing.assign(is_continuous.size(), 1);
    shrunk_.passing.resize(is_continuous.size());
  }

  Shrunk run() {
    do {
      while (set_some_back()) {
      }
    } while (move_boundaries());
    return std::move(shrunk_);
  }

 private:
  bool fails_with(std::size_t parameter, double share) const {
    Shares shares = shrunk_.failing;
    shares[parameter] = share;
    return fails_(shares);
  }

  bool set_some_back() {
    bool is_changed = false;
    for (std::size_t i = 0; i < shrunk_.failing.size(); ++i) {
      if (shrunk_.failing[i] == 0 || !fails_with(i, 0)) continue;
      shrunk_.failing[i] = 0;
      shrunk_.passing[i].reset();
      is_changed = true;
    }
    return is_changed;
  }

  /// A boundary that has moved may move others, towards the nominal case only.
  bool move_boundaries() {
    bool is_changed = false;
    for (std::size_t i = 0; i < shrunk_.failing.size(); ++i) {
      if (shrunk_.failing[i] == 0 || !is_continuous_[i]) continue;
      std::optional<double>& passing = shrunk_.passing[i];
      if (passing && !fails_with(i, *passing)) continue;
      if (passing) shrunk_.failing[i] = *passing;
      passing = 0;
      bisect(shrunk_.failing[i], *passing, i);
      is_changed = true;
    }
    return is_changed;
  }

  void bisect(double& failing, double& passing, std::size_t parameter) const {
    while (failing - passing > tolerance_) {
      const double middle = (failing + passing) / 2;
      (fails_with(parameter, middle) ? failing : passing) = middle;
    }
  }

  const std::vector<bool>& is_continuous_;
  double tolerance_;
  const std::function<bool(const Shares&)>& fails_;
  Shrunk shrunk_;
};

}  // namespace

Shrunk shrink(const std::vector<bool>& is_continuous, double tolerance,
              const std::function<bool(const Shares&)>& fails) {
  return Shrinking(is_continuous, tolerance, fails).run();
}

}  // namespace stride::search
