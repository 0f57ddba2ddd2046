#include "master/loader/fmu/instance/printf_text.h"

#include <cstdint>
#include <cstring>

#include <catch2/catch.hpp>
#include <sys/mman.h>
#include <unistd.h>

using namespace stride;

namespace {

std::string text(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  const std::string text = importer::printf_text(format, arguments);
  va_end(arguments);
  return text;
}

}  // namespace

TEST_CASE("messages are formatted as printf does") {
  CHECK(text("plain") == "plain");
  CHECK(text("%d of %s: %.2f %%", 3, "ten", 0.25) == "3 of ten: 0.25 %");
  CHECK(text("%5000d", 1).size() == 5000);
  CHECK(text("%s", std::string(511, 'x').c_str()) == std::string(511, 'x'));
  CHECK(text("%s|%5s|%-5s|%.2s|%*.*s|", "a", "b", "c", "def", 4, 1, "gh") ==
        "a|    b|c    |de|   g|");
  CHECK(text("%+i %u %#x %X %o %c %5.1f %e %g %G %a", -1, 2u, 255, 255u, 8, 'z', 2.25, 1.0, 1e9,
             1e-9, 1.0) == "-1 2 0xff FF 10 z   2.2 1.000000e+00 1e+09 1E-09 0x1p+0");
  CHECK(text("%hhd %hd %ld %lld %zu %jd %td %lu", 1, -2, 3L, -4LL, std::size_t(5),
             std::intmax_t(-6), std::ptrdiff_t(7),
             ~0UL) == "1 -2 3 -4 5 -6 7 18446744073709551615");
  CHECK(text("%Lf %p", 1.5L, nullptr) == "1.500000 (nil)");
  CHECK(text("%-*d|%.*f", -4, 1, -1, 0.5) == "1   |0.500000");
}

TEST_CASE("more arguments than fit into registers come in their order") {
  CHECK(text("%d%d%d%d%d%d%d%d %g%g%g%g%g%g%g%g%g%g %s", 1, 2, 3, 4, 5, 6, 7, 8, 1., 2., 3., 4., 5.,
             6., 7., 8., 9., 10., "end") == "12345678 12345678910 end");
}

TEST_CASE("arguments may be named by their places") {
  CHECK(text("%2$s of %1$d: %3$.2f %%, %1$03d again", 3, "ten", 0.25) ==
        "ten of 3: 0.25 %, 003 again");
  CHECK(text("%2$lld %1$s", "x", -4LL) == "-4 x");
}

TEST_CASE("places without a known type, or beside arguments without places, are left") {
  CHECK(text("%2$s", 1, "x") == "%2$s");
  CHECK(text("%1$s %s", "x", "y") == "%1$s %s");
  CHECK(text("%1$s %1$d", "x") == "%1$s %1$d");
  CHECK(text("%1$*d", 1, 2) == "%1$*d");
  CHECK(text("%0$d %d", 1) == "%0$d %d");
}

TEST_CASE("a text whose memory cannot be read is none") {
  CHECK(text("<%s> <%s> %d", nullptr, reinterpret_cast<const char*>(8), 3) ==
        "<(no text)> <(no text)> 3");
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* const memory =
      ::mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  char* const end = static_cast<char*>(memory) + page;
  REQUIRE(::mprotect(end, page, PROT_NONE) == 0);
  std::memcpy(end - 3, "abc", 3);
  CHECK(text("%s", end - 3) == "(no text)");
  CHECK(text("%.3s", end - 3) == "abc");
  CHECK(text("%s", end) == "(no text)");
  CHECK(text("%ls", end) == "(no text)");
  end[-1] = '\0';
  CHECK(text("%s", end - 3) == "ab");
  ::munmap(memory, 2 * page);
}

TEST_CASE("what printf does not know, or would write to memory, is left as it is") {
  CHECK(text("100%n") == "100%n");
  CHECK(text("%d %-5.3hhn %d", 1) == "1 %-5.3hhn %d");
  CHECK(text("%%n %d", 1) == "%n 1");
  CHECK(text("%") == "%");
  CHECK(text("100%") == "100%");
  CHECK(text("%y %d") == "%y %d");
  CHECK(text("%99999999999d") == "%99999999999d");
  CHECK(text("%.99999999999d") == "%.99999999999d");
  CHECK(text("%*d|", 2'000'000'000, 1).size() == 100'001);
}
