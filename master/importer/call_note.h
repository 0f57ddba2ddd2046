#ifndef STRIDE_MASTER_IMPORTER_CALL_NOTE_H
#define STRIDE_MASTER_IMPORTER_CALL_NOTE_H

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

namespace stride::importer {

/// The name of the function of a unit that is being called, for whoever looks into the memory of a
/// process that has crashed.
class CallNote {
 public:
  void write(const char* function) {
    const std::size_t size = std::min(std::strlen(function), name_.size() - 1);
    std::memcpy(name_.data(), function, size);
    name_[size] = '\0';
  }
  void clear() { name_[0] = '\0'; }

  /// Empty if no function is being called.
  std::string read() const { return {name_.data(), ::strnlen(name_.data(), name_.size())}; }

 private:
  std::array<char, 64> name_{};
};

}  // namespace stride::importer

#endif
