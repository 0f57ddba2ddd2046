#ifndef STRIDE_MASTER_ISOLATION_PROCESS_SHARED_NOTE_H
#define STRIDE_MASTER_ISOLATION_PROCESS_SHARED_NOTE_H

#include <cstdint>
#include <string>

#include "master/isolation/process/shared_memory.h"

namespace stride::isolation {

/// Text in memory that a process shares with the children that it makes afterwards, so that it
/// outlives them: what they were at. Throws std::system_error if there is no memory for it.
class SharedNote {
 public:
  /// `what` is cut off after some 100 characters. `picoseconds`: the simulated time.
  void write(const char* what, std::int64_t picoseconds);
  void clear() { write("", 0); }

  std::string what() const;
  std::int64_t picoseconds() const { return memory_->picoseconds; }

 private:
  struct Memory {
    std::int64_t picoseconds;
    char what[120];
  };
  Shared<Memory> memory_;
};

}  // namespace stride::isolation

#endif
