#include "master/system/ssp/uri.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "master/base/files/input_file.h"
#include "master/base/files/loose_path.h"
#include "master/base/text/hex.h"
#include "master/base/text/lower_case.h"

namespace stride::ssp {
namespace {

namespace fs = std::filesystem;

std::string take_scheme(std::string_view& uri) {
  const std::size_t end = uri.find_first_of(":/?#");
  if (end == std::string_view::npos || end == 0 || uri[end] != ':') return {};
  std::string scheme = core::lower_case(std::string(uri.substr(0, end)));
  uri.remove_prefix(end + 1);
  return scheme;
}

std::string percent_decoded(std::string_view text, const xml::Element& element) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const auto byte = core::hex_byte(text.substr(i + 1));
    if (!byte || *byte == 0) {
      element.fail(fmt::format("source=\"{}\" has a '%' that is not followed by two hexadecimal "
                               "digits",
                               text),
                   "write %25 for a percent sign");
    }
    decoded += static_cast<char>(*byte);
    i += 2;
  }
  return decoded;
}

using FoundFile = std::optional<std::filesystem::path>;

/// What this path leads to, as it is written.
FoundFile if_there(const std::filesystem::path& path) {
  return core::path_exists(path) ? FoundFile(path.lexically_normal()) : std::nullopt;
}

/// Where tools mean a file that is not where the path leads to: with the separators of Windows, and
/// in the folder of a package's resources.
FoundFile find_elsewhere(std::string path, const std::filesystem::path& folder) {
  if (core::path_exists(folder / path)) return std::nullopt;
  std::ranges::replace(path, '\\', '/');
  if (const FoundFile found = if_there(folder / path)) return found;
  return if_there(folder / "resources" / path);
}

/// Likewise, a file whose name is written in another way.
FoundFile find_similar(std::string path, const std::filesystem::path& folder) {
  std::ranges::replace(path, '\\', '/');
  const FoundFile found = core::find_loosely(folder, path);
  return found ? found : core::find_loosely(folder / "resources", path);
}

[[noreturn]] void fail_windows(const xml::Element& element, const std::string& source) {
  element.fail(fmt::format("source=\"{}\" is a path of Windows", source),
               "name the file relative to this one");
}

/// As "/C:/unit.fmu" in a URI.
bool has_drive(std::string_view path) {
  path.remove_prefix(path.starts_with('/') ? 1 : 0);
  const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
  return path.size() > 2 && is_letter(path[0]) && (path[1] == ':' || path[1] == '|') &&
         (path[2] == '/' || path[2] == '\\');
}

[[noreturn]] void fail_scheme(const xml::Element& element, const std::string& source,
                              const std::string& scheme) {
  if (scheme == "proxyfmu" || scheme == "proxy-fmu") {
    element.fail(
        fmt::format("source=\"{}\": this requires a server, proxy-fmu, that runs an FMU in another "
                    "process",
                    source),
        "name the FMU itself, and give it a process of its own with <stride:Host "
        "components=\"…\"/> "
        "or --isolate");
  }
  if (scheme.size() == 1) fail_windows(element, source);
  element.fail(fmt::format("source=\"{}\": only files can be read, not '{}:'", source, scheme),
               "download it, and name the file relative to this one");
}

Source source_in(const fs::path& folder, const xml::Element& element) {
  const std::string source = source_text(element);
  if (source.find_first_of("%?#:") != source.npos) {
    if (const FoundFile literal = if_there(folder / source)) return {*literal, ""};
  }
  std::string_view rest = source;
  const std::string scheme = take_scheme(rest);
  if (!scheme.empty() && scheme != "file") fail_scheme(element, source, scheme);
  if (rest.substr(0, 2) == "//") {
    const std::size_t path = rest.find('/', 2);
    const std::string_view host = rest.substr(2, path - 2);
    if (const FoundFile relative = if_there(folder / rest.substr(2))) return {*relative, ""};
    if (path == std::string_view::npos || (!host.empty() && host != "localhost")) {
      element.fail(fmt::format("source=\"{}\" names a file on another machine", source),
                   "write file:///path for a file on this one");
    }
    rest.remove_prefix(path);
  }
  const std::size_t hash = rest.find('#');
  const std::string_view fragment = hash == rest.npos ? "" : rest.substr(hash + 1);
  rest = rest.substr(0, hash);
  if (rest.find('?') != std::string_view::npos) {
    element.fail(fmt::format("source=\"{}\" has a query", source),
                 "write %3F if the file's name has a '?'");
  }
  const std::string path = percent_decoded(rest, element);
  if (has_drive(path) && !core::path_exists(folder / path)) fail_windows(element, source);
  Source found{find_elsewhere(path, folder).value_or((folder / path).lexically_normal()),
               percent_decoded(fragment, element)};
  if (core::path_exists(found.path)) return found;
  if (const FoundFile similar = find_similar(path, folder)) {
    found.path = *similar;
    found.warning = core::to_text({.where = element.where()}) +
                    fmt::format(
                        "source=\"{}\" is taken for the file '{}', whose name differs by "
                        "case or by the form of its letters",
                        source, similar->filename().string());
  }
  return found;
}

}  // namespace

bool has_source(const xml::Element& element) {
  return !xml::without_blanks(element.attribute_or("source")).empty();
}

std::string source_text(const xml::Element& element) {
  return xml::without_blanks(element.required("source"));
}

std::vector<fs::path> source_folders(const fs::path& file) {
  std::vector<fs::path> folders{file.parent_path()};
  std::error_code error;
  if (!fs::is_symlink(file, error)) return folders;
  const fs::path target = fs::canonical(file, error);
  if (!error) folders.push_back(target.parent_path());
  return folders;
}

Source source_of(const xml::Element& element, std::span<const fs::path> folders) {
  Source first = source_in(folders.front(), element);
  for (const fs::path& folder : folders.subspan(1)) {
    if (core::path_exists(first.path)) break;
    Source other = source_in(folder, element);
    if (core::path_exists(other.path)) return other;
  }
  return first;
}

std::filesystem::path source_path(const xml::Element& element,
                                  std::span<const std::filesystem::path> folders,
                                  std::vector<std::string>& warnings) {
  Source source = source_of(element, folders);
  if (!source.fragment.empty()) {
    element.fail_unsupported(fmt::format("a source with a fragment, which names a part of a file: "
                                         "\"{}\"",
                                         element.required("source")),
                             "write %23 if the file's name has a '#'");
  }
  if (!source.warning.empty()) warnings.push_back(source.warning);
  return source.path;
}

}  // namespace stride::ssp
