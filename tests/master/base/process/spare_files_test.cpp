#include "master/base/process/spare_files.h"

#include <vector>

#include <catch2/catch.hpp>
#include <fcntl.h>

#include "tests/master/base/open_file_limit.h"

using namespace stride::core;
using namespace stride::tests;

namespace {

Descriptor open_something() { return Descriptor(::open("/dev/null", O_RDONLY | O_CLOEXEC)); }

}  // namespace

TEST_CASE("where all files are taken, there is room again when the spare ones are released") {
  const SpareFiles spare;
  const OpenFileLimit limit(256);
  std::vector<Descriptor> taken;
  do {
    taken.push_back(open_something());
  } while (taken.back().is_open());
  SpareFiles::release_all();
  std::vector<Descriptor> further;
  for (int i = 0; i < 10; ++i) {
    further.push_back(open_something());
    CHECK(further.back().is_open());
  }
}
