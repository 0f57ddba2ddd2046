// Text that is written in one go and read in one go.
#ifndef STRIDE_MASTER_OBSERVE_TRACE_SPOOL_H
#define STRIDE_MASTER_OBSERVE_TRACE_SPOOL_H

#include <string>
#include <string_view>

#include "master/base/files/output_file.h"

namespace stride::trace {

/// Holds text of any length: what is more than 4 MiB goes to a nameless file in the system's folder
/// for temporary files.
class Spool {
 public:
  Spool() = default;
  ~Spool();
  Spool(const Spool&) = delete;
  Spool& operator=(const Spool&) = delete;

  void write(std::string_view text) {
    memory_.append(text);
    if (memory_.size() >= kMost) spill();
  }
  void write(char c) { memory_.push_back(c); }
  bool empty() const { return memory_.empty() && spilled_ == 0; }
  void clear();
  void copy_to(core::OutputFile& file) const;

 private:
  static constexpr std::size_t kMost = std::size_t{4} << 20;

  void spill();

  std::string memory_;  ///< what comes after that in the file
  int descriptor_ = -1;
  std::size_t spilled_ = 0;
};

}  // namespace stride::trace

#endif
