#include "master/base/archive/zip_directory.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include <sys/stat.h>
#include <unistd.h>

namespace stride::archive {
namespace {

constexpr std::size_t kRecord = 22;  // the end of the central directory, without its comment
constexpr std::size_t kLongestComment = 0xFFFF;
constexpr std::size_t kLocator = 20;     // that of zip64, right before it
constexpr std::size_t kRecord64 = 56;    // that of zip64
constexpr std::uint64_t kIn64 = 0xFFFF;  // the number is in the record of zip64

/// Up to `size` bytes at this offset; fewer where they cannot be read.
std::string bytes_at(int file, std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '\0');
  const ssize_t count = ::pread(file, bytes.data(), size, static_cast<off_t>(offset));
  bytes.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  return bytes;
}

/// Little-endian.
std::uint64_t number_at(std::string_view bytes, std::size_t place, std::size_t size) {
  std::uint64_t number = 0;
  for (std::size_t i = size; i > 0; --i) {
    number = number << 8 | static_cast<unsigned char>(bytes[place + i - 1]);
  }
  return number;
}

std::optional<std::uint64_t> entries_of_zip64(int file, std::string_view locator) {
  if (!locator.starts_with("PK\x06\x07")) return std::nullopt;
  const std::string record = bytes_at(file, number_at(locator, 8, 8), kRecord64);
  if (record.size() < kRecord64 || !record.starts_with("PK\x06\x06")) return std::nullopt;
  return number_at(record, 32, 8);
}

}  // namespace

std::optional<std::uint64_t> announced_entries(const core::Descriptor& file) {
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return std::nullopt;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const std::size_t wanted = kLocator + kRecord + kLongestComment;
  const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(size, wanted));
  const std::string tail = bytes_at(file.number(), size - count, count);
  const std::size_t record = tail.rfind("PK\x05\x06");
  if (record == std::string::npos || tail.size() - record < kRecord) return std::nullopt;
  const std::uint64_t entries = number_at(tail, record + 10, 2);
  if (entries != kIn64 || record < kLocator) return entries;
  const std::string_view locator = std::string_view(tail).substr(record - kLocator, kLocator);
  return entries_of_zip64(file.number(), locator).value_or(entries);
}

}  // namespace stride::archive
