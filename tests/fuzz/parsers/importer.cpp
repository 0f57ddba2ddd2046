// What an FMU consists of.
#include <array>
#include <cstring>

#include <elf.h>
#include <link.h>

#include "master/base/archive/zip.h"
#include "master/loader/fmu/description/build_description.h"
#include "master/loader/fmu/description/idle_manifest.h"
#include "master/loader/fmu/description/model_description.h"
#include "master/loader/fmu/description/terminals.h"
#include "master/loader/fmu/fmu.h"
#include "master/loader/fmu/library/library_file.h"
#include "tests/fuzz/core_errors.h"
#include "tests/fuzz/parser.h"
#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

void read_model_description(const std::string& bytes) {
  refusing_input("x.xml", [&] {
    const auto read = importer::parse_model_description(bytes, "x.xml");
    if (!read.fmi2) return;
    ensure(read.fmi2->references.size() == read.variables.size(), "each variable has a reference");
  });
}

void read_idle_manifest(const std::string& bytes) {
  static const core::UnitDescription unit = importer::read_model_description(
      copy_seed("model_description/idler.xml", "idler/modelDescription.xml"));
  refusing_input("x.xml", [&] {
    core::UnitDescription read = unit;
    importer::parse_idle_manifest(bytes, "x.xml", read);
    ensure(read.promises_idle, "a manifest is a promise");
    for (const core::Variable& variable : read.variables) {
      ensure(variable.deadband >= 0, "a deadband is not negative");
      ensure(variable.tolerance.value_or(1) > 0, "a tolerance is above 0");
    }
  });
}

/// In a folder of an FMU, by this name.
std::filesystem::path fmu_with(const std::string& name, const std::string& bytes) {
  write_file("parts/" + name, bytes);
  return working_path("parts");
}

void read_build_description(const std::string& bytes) {
  core::UnitDescription unit;
  unit.fmi_version = "3.0";
  unit.model_identifier = "tank";
  const auto folder = fmu_with("sources/buildDescription.xml", bytes);
  refusing_input("", [&] {
    for (const auto& set :
         importer::read_build_description(folder / "modelDescription.xml", unit).sets) {
      for (const auto& file : set.files) {
        ensure(file.is_relative() && *file.begin() != "..", "sources are within the FMU");
      }
    }
  });
}

void read_terminals(const std::string& bytes) {
  const auto folder = fmu_with("terminalsAndIcons/terminalsAndIcons.xml", bytes);
  refusing_input("", [&] {
    for (const auto& terminal : importer::read_terminals(folder, "x.fmu")) {
      importer::match_terminals(terminal, terminal);
    }
  });
}

std::string fmu_bytes() {
  const auto file = working_path("seed.fmu");
  archive::Contents contents;
  contents["modelDescription.xml"].file =
      copy_seed("model_description/fmi2_relaxation.xml", "relaxation.xml");
  contents["binaries/linux64/fmi2_relaxation.so"] = {"not a library", {}, true};
  contents["resources/table.csv"].text = std::string(2000, '7');
  archive::write_zip(file, contents);
  return content_of(file);
}

void read_fmu(const std::string& bytes) {
  refusing_input("", [&] { importer::Fmu::load(write_file("x.fmu", bytes)); });
  ensure(is_tidy(), "archives leave nothing behind");
}

/// A library without content: code, data, and a dynamic section in them.
std::string library_bytes() {
  constexpr std::uint64_t kPage = 0x1000;
  ElfW(Ehdr) header{};
  std::memcpy(header.e_ident, ELFMAG, SELFMAG);
  header.e_ident[EI_CLASS] = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  header.e_type = ET_DYN;
  header.e_phoff = sizeof header;
  header.e_phentsize = sizeof(ElfW(Phdr));
  std::array<ElfW(Phdr), 4> segments{};
  header.e_phnum = segments.size();
  const auto set = [&](std::size_t i, std::uint32_t type, std::uint64_t place, std::uint64_t size) {
    segments[i].p_type = type;
    segments[i].p_offset = segments[i].p_vaddr = place;
    segments[i].p_filesz = segments[i].p_memsz = size;
  };
  set(0, PT_LOAD, 0, kPage / 2);
  set(1, PT_LOAD, kPage, kPage / 2);
  set(2, PT_DYNAMIC, kPage, 0x100);
  set(3, PT_GNU_RELRO, kPage, 0x200);
  std::string bytes(2 * kPage, '\0');
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, segments.data(), sizeof segments);
  return bytes;
}

void read_library_headers(const std::string& bytes) {
  const std::string damage = importer::find_damage(write_file("x.so", bytes));
  if (!damage.empty()) throw Refusal(damage);
}

const Registration kImporterParsers(
    "importer",
    {
        {.name = "model_description",
         .read = read_model_description,
         .seed_files = {"tests/fuzz/seeds/model_description",
                        "tests/test_units/resizable/modelDescription.xml"}},
        {.name = "idle_manifest",
         .read = read_idle_manifest,
         .seed_files = {"tests/fuzz/seeds/idle_manifest"}},
        {.name = "build_description",
         .read = read_build_description,
         .seed_files = {"tests/fuzz/seeds/build_description"}},
        {.name = "terminals", .read = read_terminals, .seed_files = {"tests/fuzz/seeds/terminals"}},
        {.name = "library_headers",
         .read = read_library_headers,
         .make_seed = library_bytes,
         .alphabet = std::string("\0\x01\x02\x06\x10\x38\x7f\xff", 8)},
        {.name = "fmu_archive",
         .read = read_fmu,
         .make_seed = fmu_bytes,
         .alphabet = std::string("PK\x01\x02\x03\x04\x05\x06/.\0\xff", 12)},
    });

}  // namespace
}  // namespace stride::tests
