// The identifier codes of a value change dump.
#ifndef STRIDE_MASTER_TRACE_CODE_TABLE_H
#define STRIDE_MASTER_TRACE_CODE_TABLE_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stride::trace {

/// Numbers the codes from 0, in the order in which they come. Looking one up is what reading a
/// trace does most, so codes of up to eight characters, that is practically all, are compared as
/// integers.
class CodeTable {
 public:
  /// The number of a code, a new one where it is not known. It is not empty and has no NUL in it.
  std::uint32_t add(std::string_view code);
  std::optional<std::uint32_t> find(std::string_view code) const;
  std::uint32_t size() const { return size_; }

 private:
  struct Slot {
    std::uint64_t key = 0;  ///< the characters; 0 is an empty slot
    std::uint32_t number = 0;
  };

  std::size_t slot_of(std::uint64_t key) const;
  void grow();

  std::vector<Slot> slots_ = std::vector<Slot>(64);  ///< open addressing, a power of two
  std::unordered_map<std::string, std::uint32_t> long_codes_;
  std::uint32_t size_ = 0;
};

}  // namespace stride::trace

#endif
