#include "master/loader/fmu/library/library_file.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include <elf.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include "master/base/files/descriptor.h"

namespace stride::importer {
namespace {

using Header = ElfW(Ehdr);
using Segment = ElfW(Phdr);
using Section = ElfW(Shdr);
using Symbol = ElfW(Sym);
using Entry = ElfW(Dyn);

constexpr unsigned char kClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;

/// Of bytes in the file, or of addresses.
struct Range {
  std::uint64_t begin, size;

  bool is_in(const Range& other) const {
    return begin >= other.begin && size <= other.size && begin - other.begin <= other.size - size;
  }
};

Range in_file(const Segment& segment) { return {segment.p_offset, segment.p_filesz}; }
Range in_memory(const Segment& segment) { return {segment.p_vaddr, segment.p_memsz}; }

/// Texts that end in a NUL character, by their places.
struct Texts {
  std::vector<char> bytes;

  /// Empty if there is none.
  std::string at(std::uint64_t place) const {
    if (place >= bytes.size()) return "";
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(place);
    return {first, std::find(first, bytes.end(), '\0')};
  }
};

class LibraryFile {
 public:
  explicit LibraryFile(const std::filesystem::path& path, int access = O_RDONLY)
      : file_(::open(path.c_str(), access | O_NONBLOCK | O_CLOEXEC)) {
    struct stat status {};
    if (!file_.is_open() || ::fstat(file_.number(), &status) != 0) return;
    if (S_ISREG(status.st_mode)) size_ = static_cast<std::uint64_t>(status.st_size);
  }

  std::string damage() const {
    Header header{};
    if (!read(&header, {0, sizeof header}) || !is_for_loader(header)) return "";
    std::vector<Segment> segments(header.e_phnum);
    const Range table{header.e_phoff, segments.size() * sizeof(Segment)};
    if (!read(segments.data(), table)) return cut_off(table);
    return damage(segments);
  }

  DynamicPart dynamic_part() const {
    DynamicPart part;
    const std::vector<Section> sections = this->sections();
    if (const auto symbols = content_of(SHT_DYNSYM, sections)) {
      add_symbols(table<Symbol>(symbols->content), symbols->texts, part);
    }
    if (const auto entries = content_of(SHT_DYNAMIC, sections)) {
      add_entries(table<Entry>(entries->content), entries->texts, part);
      part.texts_begin = entries->texts_begin;
      part.texts_size = entries->texts.bytes.size();
    }
    return part;
  }

  /// Whether all of them could be written.
  bool make_ordinary(const std::set<std::string>& names) const {
    const auto part = content_of(SHT_DYNSYM, sections());
    if (!part) return false;
    std::uint64_t place = part->content.begin;
    for (const Symbol& symbol : table<Symbol>(part->content)) {
      const unsigned type = ELF64_ST_TYPE(symbol.st_info);
      const auto info = static_cast<unsigned char>(ELF64_ST_INFO(STB_GLOBAL, type));
      const bool is_meant = ELF64_ST_BIND(symbol.st_info) == STB_GNU_UNIQUE &&
                            names.contains(part->texts.at(symbol.st_name));
      const auto at = static_cast<off_t>(place + offsetof(Symbol, st_info));
      if (is_meant && ::pwrite(file_.number(), &info, 1, at) != 1) return false;
      place += sizeof symbol;
    }
    return true;
  }

 private:
  /// The first section of a type, and the texts that its elements refer to.
  struct SectionContent {
    Range content;
    Texts texts;
    std::uint64_t texts_begin;
  };

  /// None of what is not for this machine.
  std::vector<Section> sections() const {
    Header header{};
    if (!read(&header, {0, sizeof header}) || !is_for_loader(header)) return {};
    return table<Section>({header.e_shoff, header.e_shnum * sizeof(Section)});
  }

  std::optional<SectionContent> content_of(std::uint32_t type,
                                           const std::vector<Section>& sections) const {
    const auto section = std::ranges::find(sections, type, &Section::sh_type);
    if (section == sections.end() || section->sh_link >= sections.size()) return std::nullopt;
    const Section& strings = sections[section->sh_link];
    return SectionContent{{section->sh_offset, section->sh_size},
                          {table<char>({strings.sh_offset, strings.sh_size})},
                          strings.sh_offset};
  }

  static void add_symbols(const std::vector<Symbol>& symbols, const Texts& texts,
                          DynamicPart& part) {
    for (const Symbol& symbol : symbols) {
      const unsigned binding = ELF64_ST_BIND(symbol.st_info);
      const unsigned type = ELF64_ST_TYPE(symbol.st_info);
      if (binding == STB_LOCAL || symbol.st_shndx == SHN_ABS) continue;
      const bool is_defined = symbol.st_shndx != SHN_UNDEF;
      const bool is_function = type == STT_FUNC || type == STT_GNU_IFUNC;
      std::string name = texts.at(symbol.st_name);
      if (name.empty()) continue;
      const bool is_unique = is_defined && binding == STB_GNU_UNIQUE;
      part.stays_loaded |= is_unique;
      part.symbols.push_back({std::move(name), is_defined, is_function, is_unique});
    }
  }

  static void add_entries(const std::vector<Entry>& entries, const Texts& texts,
                          DynamicPart& part) {
    for (const Entry& entry : entries) {
      const auto value = entry.d_un.d_val;
      switch (entry.d_tag) {
        case DT_NULL:
          return;
        case DT_NEEDED:
          part.needed.push_back(texts.at(value));
          break;
        case DT_RPATH:
        case DT_RUNPATH:
          add_folders(texts.at(value), part);
          break;
        case DT_SYMBOLIC:
          part.binds_to_itself = true;
          break;
        case DT_FLAGS:
          part.binds_to_itself |= (value & DF_SYMBOLIC) != 0;
          break;
        case DT_FLAGS_1:
          part.stays_loaded |= (value & DF_1_NODELETE) != 0;
          break;
        default:
          break;
      }
    }
  }

  static void add_folders(const std::string& list, DynamicPart& part) {
    std::istringstream folders(list);
    for (std::string folder; std::getline(folders, folder, ':');) {
      part.search_path.push_back(folder);
    }
  }

  /// What is there of it, nothing if it goes beyond the end of the file.
  template <class Element>
  std::vector<Element> table(const Range& range) const {
    if (!range.is_in({0, size_})) return {};
    std::vector<Element> elements(range.size / sizeof(Element));
    const bool is_read = read(elements.data(), {range.begin, elements.size() * sizeof(Element)});
    return is_read ? elements : std::vector<Element>();
  }

  bool read(void* target, const Range& range) const {
    if (!range.is_in({0, size_})) return false;
    const ssize_t count =
        ::pread(file_.number(), target, range.size, static_cast<off_t>(range.begin));
    return count >= 0 && static_cast<std::uint64_t>(count) == range.size;
  }

  /// The loader complains about any other one.
  static bool is_for_loader(const Header& header) {
    return std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0 &&
           header.e_ident[EI_CLASS] == kClass && header.e_type == ET_DYN &&
           header.e_phentsize == sizeof(Segment);
  }

  std::string cut_off(const Range& missing) const {
    return fmt::format(
        "its file has {} bytes, and its headers name bytes up to {}, so it is cut "
        "off or damaged",
        size_, missing.begin + missing.size);
  }

  std::string damage(const std::vector<Segment>& segments) const {
    std::vector<Segment> loaded;
    std::ranges::copy_if(segments, std::back_inserter(loaded),
                         [](const Segment& segment) { return segment.p_type == PT_LOAD; });
    for (const Segment& segment : loaded) {
      if (!in_file(segment).is_in({0, size_})) return cut_off(in_file(segment));
      if (segment.p_filesz > segment.p_memsz) {
        return "a segment is larger in the file than in memory, so its headers are damaged";
      }
    }
    if (!are_in_order(loaded)) {
      return "its segments overlap or are not in order, so its headers are damaged";
    }
    for (const Segment& segment : segments) {
      const auto holds = [&](const Segment& part) {
        return in_memory(segment).is_in(in_memory(part));
      };
      if (segment.p_type == PT_DYNAMIC && std::ranges::none_of(loaded, holds)) {
        return "its dynamic section is in none of its segments, so its headers are damaged";
      }
      if (segment.p_type == PT_GNU_RELRO && !begins_in(segment, loaded)) {
        return "its read-only part is in none of its segments, so its headers are damaged";
      }
    }
    return "";
  }

  /// The loader makes room up to the end of the last one, and puts each where it says.
  static bool are_in_order(const std::vector<Segment>& loaded) {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 46;
    std::uint64_t end = 0;
    for (const Segment& segment : loaded) {
      const auto [begin, size] = in_memory(segment);
      if (begin < end || begin > kMost || size > kMost) return false;
      end = begin + size;
    }
    return true;
  }

  /// Its end may be rounded up to that of a page.
  static bool begins_in(const Segment& segment, const std::vector<Segment>& loaded) {
    const auto page = static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return std::ranges::any_of(loaded, [&](const Segment& part) {
      const auto [begin, size] = in_memory(part);
      return in_memory(segment).is_in({begin, size + 2 * page});
    });
  }

  core::Descriptor file_;
  std::uint64_t size_ = 0;
};

}  // namespace

std::string find_damage(const std::filesystem::path& library) {
  return LibraryFile(library).damage();
}

DynamicPart read_dynamic_part(const std::filesystem::path& library) {
  return LibraryFile(library).dynamic_part();
}

void make_ordinary(const std::filesystem::path& library, const std::set<std::string>& symbols) {
  if (LibraryFile(library, O_RDWR).make_ordinary(symbols)) return;
  throw std::filesystem::filesystem_error("cannot write", library,
                                          std::make_error_code(std::errc::io_error));
}

std::set<std::string> exported_names(const std::filesystem::path& library) {
  std::set<std::string> names;
  for (DynamicSymbol& symbol : read_dynamic_part(library).symbols) {
    if (symbol.is_defined) names.insert(std::move(symbol.name));
  }
  return names;
}

}  // namespace stride::importer
