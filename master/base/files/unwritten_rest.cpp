#include "master/base/files/unwritten_rest.h"

#include <algorithm>
#include <cerrno>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include "master/base/files/descriptor.h"

namespace stride::core {

std::optional<std::int64_t> UnwrittenRest::write_to(int file) const noexcept {
  const std::size_t lines = std::string_view(bytes, std::min(size, kCapacity)).rfind('\n') + 1;
  for (std::size_t done = 0; done < lines;) {
    const auto at = place + static_cast<std::int64_t>(done);
    const ssize_t count = ::pwrite(file, bytes + done, lines - done, at);
    if (count < 0 && errno != EINTR) return std::nullopt;
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  const std::int64_t end = lines > 0 ? place + static_cast<std::int64_t>(lines) : line_end;
  if (::ftruncate(file, end) != 0) return std::nullopt;
  return end;
}

void UnwrittenRest::write() const {
  const std::string file(path.view());
  if (file.empty()) return;
  const Descriptor open(::open(file.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (FileIdentity::of(open.number()) == identity) write_to(open.number());
}

}  // namespace stride::core
