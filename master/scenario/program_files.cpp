#include "master/scenario/program_files.h"

#include <fmt/format.h>

#include "master/util/xml/document.h"

namespace stride::io {
namespace {

namespace fs = std::filesystem;

void add_file(ProgramFiles& files, const xml::Element& element, const fs::path& folder) {
  const auto named = element.attribute("file");
  if (!named) return;
  const fs::path path = (folder / *named).lexically_normal();
  if (!fs::is_regular_file(path)) {
    element.fail(fmt::format("file=\"{}\": there is no file {}", *named, path.string()),
                 "name it relative to this declaration");
  }
  if (element.flag("outside")) {
    files.has_outside = true;
    return;
  }
  const auto [place, is_new] = files.packed.emplace(path.filename().string(), path);
  if (is_new || place->second == path) return;
  element.fail(
      fmt::format("file=\"{}\": another file of this name is {}", *named, place->second.string()),
      "all files of a program lie in one folder when they are packed: give them "
      "different names");
}

}  // namespace

ProgramFiles program_files(const fs::path& declaration) {
  const xml::Document document(declaration);
  const xml::Element root = document.root();
  if (!root.is("", "process")) {
    root.fail(fmt::format("{} is no declaration of a program", root.tag()),
              "its root is <process version=\"1\">: see docs/process-protocol.md");
  }
  const fs::path folder = fs::absolute(declaration).parent_path();
  ProgramFiles files;
  for (const xml::Element& child : root.children()) add_file(files, child, folder);
  return files;
}

}  // namespace stride::io
