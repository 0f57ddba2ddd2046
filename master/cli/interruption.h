#ifndef STRIDE_MASTER_CLI_INTERRUPTION_H
#define STRIDE_MASTER_CLI_INTERRUPTION_H

#include <array>
#include <csignal>

namespace stride::cli {

/// While it lives SIGINT and SIGTERM, the first of each, are noted and do nothing else. A second
/// one ends what does not look at flag().
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
