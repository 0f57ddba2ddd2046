// How numbers are written and read.
#ifndef STRIDE_MASTER_BASE_PROCESS_LOCALE_STATE_H
#define STRIDE_MASTER_BASE_PROCESS_LOCALE_STATE_H

#include <locale>
#include <string>
#include <vector>

#include <locale.h>

namespace stride::core {

/// The locale of the process as C and C++ know it, and that of the calling thread. It decides
/// between a decimal point and a decimal comma.
class LocaleState {
 public:
  LocaleState();

  /// Puts back what differs, and adds it to `changes`, in words.
  void restore(std::vector<std::string>& changes) const;

 private:
  std::string c_;
  std::locale cpp_;
  locale_t thread_;
};

}  // namespace stride::core

#endif
