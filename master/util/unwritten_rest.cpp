#include "master/util/unwritten_rest.h"

#include <algorithm>
#include <string>
#include <string_view>

#include <fcntl.h>
#include <unistd.h>

#include "master/util/descriptor.h"

namespace stride::core {

void UnwrittenRest::write() const {
  const std::string file(path.view());
  if (file.empty()) return;
  const Descriptor open(::open(file.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (FileIdentity::of(open.number()) != identity) return;
  const std::size_t lines = std::string_view(bytes, std::min(size, kCapacity)).rfind('\n') + 1;
  std::size_t done = 0;
  while (done < lines) {
    const ssize_t count = ::pwrite(open.number(), bytes + done, lines - done,
                                   place + static_cast<std::int64_t>(done));
    if (count <= 0) return;
    done += static_cast<std::size_t>(count);
  }
  const std::int64_t last = lines > 0 ? place + static_cast<std::int64_t>(lines) : line_end;
  (void)!::ftruncate(open.number(), last);
}

}  // namespace stride::core
