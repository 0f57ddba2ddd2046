#include "master/loader/process/byte_ring.h"

#include <algorithm>

namespace stride::isolation {

std::size_t ByteRing::room() const {
  const std::uint64_t used = written_.load() - read_.load(std::memory_order_acquire);
  return kSize - std::min<std::uint64_t>(used, kSize);
}

std::size_t ByteRing::write(std::string_view bytes) {
  const std::size_t size = std::min(bytes.size(), room());
  const std::uint64_t begin = written_.load();
  const std::size_t first = begin % kSize;
  const std::size_t before_wrap = std::min(size, kSize - first);
  std::copy_n(bytes.begin(), before_wrap, bytes_.begin() + static_cast<std::ptrdiff_t>(first));
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(before_wrap), size - before_wrap,
              bytes_.begin());
  written_.store(begin + size, std::memory_order_release);
  return size;
}

void ByteRing::read(std::string& bytes) {
  const std::uint64_t begin = read_.load();
  const std::uint64_t end = written_.load(std::memory_order_acquire);
  const std::size_t size = std::min<std::uint64_t>(end - begin, kSize);
  const std::size_t first = begin % kSize;
  const std::size_t before_wrap = std::min(size, kSize - first);
  bytes.append(bytes_.data() + first, before_wrap);
  bytes.append(bytes_.data(), size - before_wrap);
  read_.store(end, std::memory_order_release);
}

}  // namespace stride::isolation
