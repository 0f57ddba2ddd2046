#ifndef STRIDE_MASTER_CLI_INTERRUPTION_H
#define STRIDE_MASTER_CLI_INTERRUPTION_H

#include <array>
#include <csignal>

namespace stride::cli {

/// During its lifetime the first SIGINT and the first SIGTERM only set flag(). A second one ends
/// the process.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Not 0 after a signal.
  static const volatile std::sig_atomic_t& flag();

 private:
  struct Handled {
    int signal;
    struct sigaction before;
  };
  std::array<Handled, 2> handled_{{{SIGINT, {}}, {SIGTERM, {}}}};
};

}  // namespace stride::cli

#endif
