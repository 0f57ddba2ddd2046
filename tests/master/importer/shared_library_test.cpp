#include "master/importer/shared_library.h"

#include "master/importer/fmi3/fmi3_library.h"
#include "tests/master/importer/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

std::string error_of_loading(const fs::path& path) {
  return input_error([&] { importer::Fmi3Library(path, {"system.ssd", 3}); });
}

}  // namespace

TEST_CASE("a missing shared library is named") {
  CHECK_THAT(error_of_loading(raw_library("raw_with_missing_library")),
             Contains("needs the shared library 'libstride_test_absent.so', which was not found") &&
                 Contains("hint: install the package"));
}

TEST_CASE("an undefined symbol is named") {
  CHECK_THAT(error_of_loading(raw_library("raw_with_undefined_symbol")),
             Contains("needs the symbol 'stride_test_nobody_has_this', which no library"));
}

TEST_CASE("what is not a library for this machine is an error") {
  const Scratch scratch;
  CHECK_THAT(
      error_of_loading(scratch.write("text.so", "this is not a library, whatever its name says")),
      Contains("text.so' cannot be loaded") && Contains(importer::platform()));
  CHECK_THAT(error_of_loading(scratch / "absent.so"), Contains("absent.so' cannot be loaded"));
}
