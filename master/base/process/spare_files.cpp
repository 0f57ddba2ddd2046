#include "master/base/process/spare_files.h"

#include <fcntl.h>

namespace stride::core {

SpareFiles::SpareFiles() {
  for (Descriptor& file : files_) file = Descriptor(::open("/dev/null", O_RDONLY | O_CLOEXEC));
}

void SpareFiles::release_all() noexcept {
  Listed<SpareFiles>::for_each([](SpareFiles& spare) {
    for (Descriptor& file : spare.files_) file.close();
  });
}

}  // namespace stride::core
