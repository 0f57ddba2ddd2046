#include "tests/fuzz/parser.h"

#include <algorithm>
#include <filesystem>

#include "tests/fuzz/working_folder.h"

namespace stride::tests {
namespace {

namespace fs = std::filesystem;

std::vector<Parser>& registered() {
  static std::vector<Parser> all;
  return all;
}

bool is_before(const Parser& a, const Parser& b) { return a.name < b.name; }

std::vector<fs::path> files_at(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

[[noreturn]] void fail_unknown(const std::string& name) {
  std::string names;
  for (const Parser& parser : registered()) names += " " + parser.name;
  throw std::invalid_argument("there is no parser '" + name + "'; expected one of" + names);
}

}  // namespace

Registration::Registration(const char* group, std::initializer_list<Parser> added) {
  auto& all = registered();
  for (Parser parser : added) {
    parser.group = group;
    all.insert(std::upper_bound(all.begin(), all.end(), parser, is_before), std::move(parser));
  }
}

const std::vector<Parser>& parsers() { return registered(); }

const Parser& find_parser(const std::string& name) {
  for (const Parser& parser : parsers()) {
    if (parser.name == name) return parser;
  }
  fail_unknown(name);
}

std::vector<Parser> find_parsers(const std::string& name_or_group) {
  std::vector<Parser> found;
  for (const Parser& parser : parsers()) {
    if (parser.name == name_or_group || parser.group == name_or_group) found.push_back(parser);
  }
  if (found.empty()) fail_unknown(name_or_group);
  return found;
}

std::vector<std::string> seeds_of(const Parser& parser) {
  std::vector<std::string> seeds = parser.seeds;
  if (parser.make_seed != nullptr) seeds.push_back(parser.make_seed());
  for (const std::string& path : parser.seed_files) {
    for (const fs::path& file : files_at(fs::path(STRIDE_SOURCE_DIR) / path)) {
      seeds.push_back(content_of(file));
    }
  }
  return seeds;
}

}  // namespace stride::tests
