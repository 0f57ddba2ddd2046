#include "master/base/child_process/memory_use.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include "master/base/child_process/descriptor.h"
#include "master/base/child_process/process_memory.h"

namespace stride::isolation {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kBlock = 512;  // of st_blocks

/// The file system of memfd_create() and of shared memory without a file.
std::optional<dev_t> nameless_device() {
  const Descriptor file(::memfd_create("device", MFD_CLOEXEC));
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) return std::nullopt;
  return status.st_dev;
}

/// "36 35 98:0 /mnt1 /mnt2 rw,noatime master:1 - ext3 /dev/root rw"
std::set<dev_t> devices_in_memory() {
  std::set<dev_t> devices;
  if (const auto device = nameless_device()) devices.insert(*device);
  std::ifstream mounts("/proc/self/mountinfo");
  for (std::string line; std::getline(mounts, line);) {
    unsigned major = 0, minor = 0;
    if (std::sscanf(line.c_str(), "%*u %*u %u:%u", &major, &minor) != 2) continue;
    const std::size_t type = line.find(" - ");
    if (type == std::string::npos) continue;
    const std::string_view rest = std::string_view(line).substr(type + 3);
    if (rest.starts_with("tmpfs ") || rest.starts_with("ramfs ")) {
      devices.insert(::makedev(major, minor));
    }
  }
  return devices;
}

/// A line of smaps that begins with an address: which pages of which file, and whether writing to
/// them changes the file.
struct Mapping {
  bool is_shared = false;
  dev_t device = 0;
  ino_t number = 0;
};

/// "7f0000000000-7f0000001000 rw-s 00000000 00:01 1024   /dev/zero (deleted)"
std::optional<Mapping> mapping_of(const std::string& line) {
  char mode[5] = "";
  unsigned major = 0, minor = 0;
  unsigned long number = 0;
  if (std::sscanf(line.c_str(), "%*x-%*x %4s %*x %x:%x %lu", mode, &major, &minor, &number) != 4) {
    return std::nullopt;
  }
  return Mapping{mode[3] == 's', ::makedev(major, minor), number};
}

/// The bytes of "Pss:      12 kB"; nothing if it is another line.
std::optional<std::uint64_t> bytes_of(std::string_view line, std::string_view title) {
  if (!line.starts_with(title)) return std::nullopt;
  line.remove_prefix(std::min(line.find_first_not_of(' ', title.size()), line.size()));
  std::uint64_t kibibytes = 0;
  std::from_chars(line.data(), line.data() + line.size(), kibibytes);
  return kibibytes * 1024;
}

}  // namespace

/// Those that are in memory.
struct MemoryUse::Files {
  struct Size {
    std::uint64_t allocated = 0;  ///< where that is known
    std::uint64_t mapped = 0;     ///< by the processes
  };
  std::map<std::pair<dev_t, ino_t>, Size> sizes;

  std::uint64_t sum() const {
    std::uint64_t bytes = 0;
    for (const auto& [file, size] : sizes) bytes += std::max(size.allocated, size.mapped);
    return bytes;
  }
};

MemoryUse::MemoryUse(const std::vector<fs::path>& folders) : devices_(devices_in_memory()) {
  for (const fs::path& folder : folders) {
    struct stat status {};
    if (::stat(folder.c_str(), &status) != 0 || !is_in_memory(status.st_dev)) continue;
    folders_.push_back(folder);
  }
}

std::uint64_t MemoryUse::of(std::span<const pid_t> processes) const {
  Files files;
  add_folders(files);
  std::uint64_t bytes = 0;
  for (const pid_t process : processes) {
    const std::optional<std::uint64_t> own = proportional_memory(process);
    if (!own) {  // it does not let others look at it
      bytes += unshared_bound(process);
      continue;
    }
    bytes += *own;
    add_open_files(process, files);
    add_mappings(process, files, bytes);
  }
  return bytes + files.sum();
}

std::uint64_t MemoryUse::bound(std::span<const pid_t> processes) const {
  Files files;
  add_folders(files);
  std::uint64_t bytes = 0;
  for (const pid_t process : processes) {
    bytes += unshared_bound(process);
    add_open_files(process, files);
  }
  return bytes + files.sum();
}

void MemoryUse::add_open_files(pid_t process, Files& files) const {
  std::error_code gone;
  fs::directory_iterator file("/proc/" + std::to_string(process) + "/fd", gone);
  for (const fs::directory_iterator end; !gone && file != end; file.increment(gone)) {
    struct stat status {};
    if (::stat(file->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
    if (!is_in_memory(status.st_dev)) continue;
    files.sizes[{status.st_dev, status.st_ino}].allocated =
        static_cast<std::uint64_t>(status.st_blocks) * kBlock;
  }
}

void MemoryUse::add_folders(Files& files) const {
  for (const fs::path& folder : folders_) {
    std::error_code gone;
    constexpr auto kOptions = fs::directory_options::skip_permission_denied;
    fs::recursive_directory_iterator file(folder, kOptions, gone);
    for (const fs::recursive_directory_iterator end; !gone && file != end; file.increment(gone)) {
      struct stat status {};
      if (::lstat(file->path().c_str(), &status) != 0 || !S_ISREG(status.st_mode)) continue;
      files.sizes[{status.st_dev, status.st_ino}].allocated =
          static_cast<std::uint64_t>(status.st_blocks) * kBlock;
    }
  }
}

/// Of what is swapped out, the pages of files go to these.
void MemoryUse::add_mappings(pid_t process, Files& files, std::uint64_t& swapped) const {
  std::ifstream lines("/proc/" + std::to_string(process) + "/smaps");
  std::uint64_t* target = &swapped;
  bool is_file = false;
  for (std::string line; std::getline(lines, line);) {
    if (const std::optional<Mapping> mapping = mapping_of(line)) {
      is_file = mapping->is_shared && is_in_memory(mapping->device);
      target = is_file ? &files.sizes[{mapping->device, mapping->number}].mapped : &swapped;
    } else if (const auto bytes = bytes_of(line, "SwapPss:")) {
      *target += *bytes;
    } else if (const auto resident = bytes_of(line, "Pss:"); resident && is_file) {
      *target += *resident;
    }
  }
}

}  // namespace stride::isolation
