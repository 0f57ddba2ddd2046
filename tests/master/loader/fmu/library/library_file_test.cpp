#include "master/loader/fmu/library/library_file.h"

#include <cstring>
#include <functional>

#include <elf.h>
#include <link.h>

#include "tests/build.h"
#include "tests/master/loader/fmu/support.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;
using importer::find_damage;

namespace {

using Segment = ElfW(Phdr);

/// What is found in a library whose segments are changed.
std::string damage_with(const std::function<void(std::vector<Segment>&)>& change) {
  std::string bytes = read(raw_library("raw"));
  ElfW(Ehdr) header;
  std::memcpy(&header, bytes.data(), sizeof header);
  std::vector<Segment> segments(header.e_phnum);
  const std::size_t size = segments.size() * sizeof(Segment);
  std::memcpy(segments.data(), bytes.data() + header.e_phoff, size);
  change(segments);
  std::memcpy(bytes.data() + header.e_phoff, segments.data(), size);
  const Scratch scratch;
  return find_damage(scratch.write("changed.so", bytes));
}

/// The first one of this type, and behind it `further` others of the type.
Segment& segment_of(std::vector<Segment>& segments, std::uint32_t type, int further = 0) {
  for (Segment& segment : segments) {
    if (segment.p_type == type && further-- == 0) return segment;
  }
  throw std::runtime_error("the library has no such segment");
}

}  // namespace

TEST_CASE("nothing is wrong with libraries that can be loaded") {
  CHECK(find_damage(raw_library("raw")) == "");
  for (const char* unit : {"types", "bundling", "thrower"}) {
    CAPTURE(unit);
    CHECK(find_damage(unit_library(unit)) == "");
  }
}

TEST_CASE("the loader itself refuses what is no library for it") {
  const Scratch scratch;
  CHECK(find_damage(scratch / "absent.so") == "");
  CHECK(find_damage(scratch.write("empty.so", "")) == "");
  CHECK(find_damage(scratch.write("text.so", std::string(1000, 'x'))) == "");
  CHECK(find_damage(scratch.path()) == "");
  std::string bytes = read(raw_library("raw"));
  bytes[EI_CLASS] = ELFCLASS32;
  CHECK(find_damage(scratch.write("32.so", bytes)) == "");
}

TEST_CASE("a library that is cut off anywhere in its segments is found out") {
  const Scratch scratch;
  const std::string bytes = read(raw_library("raw"));
  for (const std::size_t size : {std::size_t{100}, std::size_t{1000}, bytes.size() / 4}) {
    CAPTURE(size);
    CHECK_THAT(find_damage(scratch.write("cut.so", bytes.substr(0, size))),
               Contains("its file has " + std::to_string(size) + " bytes") && Contains("cut off"));
  }
}

TEST_CASE("segments that would be put over other memory are found out") {
  CHECK_THAT(damage_with([](auto& s) { segment_of(s, PT_LOAD, 1).p_filesz += 0xd50000; }),
             Contains("cut off or damaged"));
  CHECK_THAT(damage_with([](auto& s) { segment_of(s, PT_LOAD).p_memsz = 1; }),
             Contains("larger in the file than in memory"));
  CHECK_THAT(
      damage_with([](auto& s) { segment_of(s, PT_LOAD, 1).p_vaddr = std::uint64_t{1} << 45; }),
      Contains("overlap or are not in order"));
  CHECK_THAT(damage_with([](auto& s) { segment_of(s, PT_LOAD).p_memsz = ~std::uint64_t{0}; }),
             Contains("overlap or are not in order"));
  CHECK_THAT(
      damage_with([](auto& s) { segment_of(s, PT_DYNAMIC).p_vaddr += std::uint64_t{1} << 30; }),
      Contains("its dynamic section is in none"));
  CHECK_THAT(damage_with([](auto& s) { segment_of(s, PT_GNU_RELRO).p_memsz += 1 << 30; }),
             Contains("its read-only part is in none"));
}

TEST_CASE("what a library exports is known before it is loaded") {
  const auto names = importer::exported_names(raw_library("raw"));
  CHECK(names.contains("fmi3DoStep"));
  CHECK_FALSE(names.contains("malloc"));  // which it needs
  const Scratch scratch;
  CHECK(importer::exported_names(scratch / "absent.so").empty());
  const std::string bytes = read(raw_library("raw"));
  const auto cut = scratch.write("cut.so", bytes.substr(0, bytes.size() / 2));
  CHECK(importer::exported_names(cut).empty());
}
