// Dependencies run one way. Targets keep it at link time; this keeps it for headers.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

/// Folder -> the folders and libraries whose headers it may include, beside its own and the
/// standard library's. The first folder below master/ is a room: docs/architecture.md shows them.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"interfaces", {"stride"}},
    {"master/base",
     {"stride/time.h", "stride/time_text.h", "stride/value_text.h", "stride/xml_text.h", "fmt",
      "iconv.h", "tinyxml2.h", "utf8.h", "archive.h", "archive_entry.h", "sha2.h", "zlib.h",
      "seccomp.h"}},
    {"master/engine/model",
     {"stride/time.h", "stride/unit_of_measure.h", "stride/value_type.h", "master/base", "fmt"}},
    {"master/engine/port", {"stride/time.h", "master/engine/model", "master/base"}},
    {"master/engine/run",
     {"stride/time.h", "master/engine/port", "master/engine/model", "master/base", "fmt", "Eigen"}},
    {"master/loader/fmu",
     {"stride/time.h", "stride/fmi1.h", "stride/fmi2.h", "stride/fmi3.h", "stride/idle.h",
      "stride/describe.h", "stride/self_description.h", "stride/xml_text.h", "master/engine/port",
      "master/engine/model", "master/base", "fmt"}},
    {"master/loader/wire",
     {"stride/time.h", "master/engine/port", "master/engine/model", "master/base", "fmt"}},
    {"master/loader/process",
     {"stride/time.h", "master/loader/wire", "master/loader/fmu", "master/engine/port",
      "master/engine/model", "master/base", "fmt"}},
    {"master/loader/network",
     {"stride/time.h", "master/loader/process", "master/loader/wire", "master/loader/fmu",
      "master/engine/port", "master/engine/model", "master/base", "fmt"}},
    {"master/observe/checks", {"stride/time.h", "master/engine", "master/base", "fmt"}},
    {"master/observe/coverage",
     {"stride/time.h", "master/engine", "master/base", "fmt", "nlohmann"}},
    {"master/observe/recorders",
     {"stride/time.h", "stride/value_text.h", "master/engine", "master/base", "fmt", "nlohmann"}},
    {"master/observe/capture",
     {"stride/time.h", "master/observe/recorders", "master/engine", "master/base", "fmt"}},
    {"master/observe/checkpoint",
     {"stride/time.h", "master/observe/recorders", "master/engine", "master/base", "fmt",
      "nlohmann", "zlib.h"}},
    {"master/observe/trace", {"stride/time.h", "master/base", "fmt"}},
    {"master/system/ssp",
     {"stride/time.h", "stride/xml_text.h", "master/engine/model", "master/base", "fmt"}},
    {"master/system/declaration",
     {"stride/time.h", "master/system/ssp", "master/observe/checks", "master/observe/coverage",
      "master/observe/recorders", "master/loader", "master/engine", "master/base", "fmt",
      "spdlog"}},
    {"master/system/scenario",
     {"stride/time.h", "master/system/declaration", "master/system/ssp", "master/observe/checks",
      "master/observe/coverage", "master/observe/recorders", "master/loader", "master/engine",
      "master/base", "fmt", "spdlog"}},
    {"master/system/plan",
     {"stride/time.h", "master/system/scenario", "master/system/declaration", "master/system/ssp",
      "master/observe/checks", "master/observe/coverage", "master/observe/recorders",
      "master/loader", "master/engine", "master/base", "fmt", "spdlog"}},
    {"master/system/settings",
     {"stride/time.h", "master/system/declaration", "master/system/plan", "master/system/ssp",
      "master/base", "fmt", "spdlog", "CLI"}},
    {"master/report",
     {"stride/time.h", "stride/value_text.h", "master/observe/recorders", "master/observe/coverage",
      "master/engine", "master/base", "fmt", "nlohmann", "zlib.h"}},
    {"master/study/campaign",
     {"stride/time.h", "master/system", "master/report", "master/observe/coverage",
      "master/observe/recorders", "master/engine", "master/base", "boost/math", "boost/random",
      "Random123", "fmt", "nlohmann"}},
    {"master/study/compare",
     {"stride/time.h", "stride/value_text.h", "master/report", "master/observe/coverage",
      "master/observe/recorders", "master/engine/model", "master/base", "fmt", "nlohmann"}},
    {"master/study/replay",
     {"stride/time.h", "master/system", "master/loader/fmu", "master/engine/model", "master/base",
      "fmt"}},
    {"master/study/results",
     {"stride/time.h", "master/system", "master/report", "master/observe", "master/engine",
      "master/base", "fmt", "spdlog"}},
    {"master/study/search",
     {"stride/time.h", "master/study/campaign", "master/base", "pagmo", "fmt"}},
    {"master/study/verify",
     {"stride/time.h", "master/loader/fmu", "master/engine", "master/base", "fmt", "nlohmann",
      "malloc.h"}},
    {"master/front/api",
     {"stride/time.h", "stride/master.h", "master/study/results", "master/system",
      "master/observe/checkpoint", "master/observe/recorders", "master/engine", "master/base",
      "fmt", "spdlog", "CLI"}},
    {"master/front/cli",
     {"stride/time.h", "master/study", "master/report", "master/system", "master/observe",
      "master/loader", "master/engine", "master/base", "boost/asio.hpp", "boost/beast", "fmt",
      "nlohmann", "spdlog", "CLI", "arpa", "netinet", "stdio_ext.h"}},
    {"units/minimal", {"stride"}},
    {"units/nfc", {"stride/time.h", "stride/value_text.h"}},
    {"units/xml", {"stride/time.h", "stride/value_text.h", "tinyxml2.h"}},
    {"units/systemc", {"stride", "systemc", "tlm_core", "tlm_utils", "sanitizer", "cxxabi.h"}},
    {"units/sensor", {"stride", "systemc", "units/nfc", "units/systemc"}},
    {"units/mujoco_world",
     {"stride", "units/xml", "mujoco", "Eigen", "iconv.h", "jpeglib.h", "stb_image_write.h",
      "tiny_gltf.h", "tinyxml2.h", "CLI"}},
    {"units/channel", {"stride", "Eigen", "units/nfc", "units/xml"}},
    {"units/nfc_channel", {"stride", "Eigen", "units/channel", "units/nfc"}},
    {"units/rf_channel", {"stride", "Eigen", "units/channel", "units/nfc"}},
    {"units/ideal_channel", {"stride", "units/channel"}},
    {"units/reader", {"stride", "units/nfc", "units/xml"}},
    {"units/environment", {"stride"}},
    {"units/ground_truth", {"stride", "units/xml"}},
    {"units/player", {"stride", "units/xml"}},
    {"units/process", {"stride", "units/xml"}},
};

/// The libraries among the units are installed, and included as a user sees them.
std::string without_installed_name(const std::string& header) {
  for (const std::string library : {"nfc/", "process/", "systemc/"}) {
    if (header.rfind("stride/" + library, 0) == 0) return "units/" + header.substr(7);
  }
  return header;
}

std::vector<std::string> includes(const fs::path& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> found;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::smatch match;
    if (std::regex_search(line, match, kInclude)) found.push_back(without_installed_name(match[1]));
  }
  return found;
}

bool begins_with(const std::string& header, const std::string& allowed) {
  return header == allowed || header.rfind(allowed + "/", 0) == 0;
}

/// Standard headers have no dot and no slash; the system's are those of POSIX and Linux.
bool is_system(const std::string& header) {
  static const std::set<std::string> kPosix = {"dirent.h",  "dlfcn.h",  "unistd.h",  "fcntl.h",
                                               "fnmatch.h", "locale.h", "poll.h",    "pthread.h",
                                               "sched.h",   "spawn.h",  "stdbool.h", "stddef.h",
                                               "stdint.h",  "elf.h",    "link.h"};
  const bool standard = header.find_first_of("./") == std::string::npos;
  return (standard && header != "systemc") || kPosix.count(header) != 0 ||
         begins_with(header, "sys") || begins_with(header, "linux");
}

bool is_source(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

/// Each part of a folder with the other parts that it includes.
using Parts = std::map<std::string, std::set<std::string>>;

std::string folder_of(const fs::path& file) { return file.parent_path().string(); }

/// A header with its source.
std::string pair(const fs::path& file) { return fs::path(file).replace_extension().string(); }

/// `part_of` maps a file, as seen from the folder, to its part.
Parts parts_of(const std::string& folder, std::string (*part_of)(const fs::path&)) {
  Parts parts;
  const fs::path path = fs::path(STRIDE_SOURCE_DIR) / folder;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (!is_source(entry.path())) continue;
    const std::string part = part_of(entry.path().lexically_relative(path));
    for (const std::string& header : includes(entry.path())) {
      if (!begins_with(header, folder)) continue;
      const std::string other = part_of(fs::path(header).lexically_relative(folder));
      if (other != part) parts[part].insert(other);
    }
  }
  return parts;
}

/// The parts that include each other in a circle, and those that include such a part.
std::string circular(Parts parts) {
  const auto is_free = [&](const auto& part) {
    return std::none_of(part.second.begin(), part.second.end(),
                        [&](const std::string& other) { return parts.count(other) != 0; });
  };
  for (auto part = parts.begin(); part != parts.end();) {
    if (!is_free(*part)) {
      ++part;
      continue;
    }
    parts.erase(part);
    part = parts.begin();
  }
  std::string names;
  for (const auto& [part, others] : parts) names += part + " ";
  return names;
}

/// "master/engine/run" -> "engine"; empty for what is not in a room of the master
std::string room_of(const std::string& folder) {
  if (!begins_with(folder, "master")) return {};
  return std::next(fs::path(folder).begin())->string();
}

bool reaches(const Parts& arrows, const std::string& from, const std::string& to) {
  const auto found = arrows.find(from);
  if (found == arrows.end()) return false;
  return std::any_of(found->second.begin(), found->second.end(), [&](const std::string& next) {
    return next == to || reaches(arrows, next, to);
  });
}

/// The rooms with their arrows as a diagram of Mermaid, without those that follow from others.
std::string picture_of_rooms() {
  Parts arrows;
  for (const auto& [folder, allowed] : kAllowed) {
    for (const std::string& other : allowed) {
      const std::string from = room_of(folder), to = room_of(other);
      if (!from.empty() && !to.empty() && from != to) arrows[from].insert(to);
    }
  }
  std::string picture = "```mermaid\nflowchart TD\n";
  for (const auto& [from, targets] : arrows) {
    for (const std::string& to : targets) {
      const bool follows =
          std::any_of(targets.begin(), targets.end(),
                      [&](const std::string& other) { return reaches(arrows, other, to); });
      if (!follows) picture += "  " + from + " --> " + to + "\n";
    }
  }
  return picture + "```\n";
}

}  // namespace

TEST_CASE("every folder includes only what it may depend on") {
  const fs::path root = STRIDE_SOURCE_DIR;
  for (const auto& [folder, allowed] : kAllowed) {
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path())) continue;
      ++files;
      for (const std::string& header : includes(entry.path())) {
        bool fine = is_system(header) || begins_with(header, folder);
        for (const std::string& other : allowed) fine = fine || begins_with(header, other);
        INFO(entry.path().lexically_relative(root).string() << " includes " << header);
        CHECK(fine);
      }
    }
    INFO(folder);
    CHECK(files > 0);
  }
}

TEST_CASE("the rules themselves run one way") {
  Parts rules;
  for (const auto& [folder, allowed] : kAllowed) {
    for (const std::string& other : allowed) {
      const bool is_own = begins_with(folder, other) || begins_with(other, folder);
      if (kAllowed.count(other) != 0 && !is_own) rules[folder].insert(other);
    }
  }
  CHECK(rules.size() > 10);
  CHECK(circular(rules).empty());
}

TEST_CASE("the engine and the checks open no files and load no libraries") {
  const std::set<std::string> kForbidden = {"filesystem", "fstream", "dlfcn.h", "fcntl.h",
                                            "unistd.h"};
  const fs::path root = fs::path(STRIDE_SOURCE_DIR) / "master";
  for (const char* folder : {"engine", "observe/checks"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path())) continue;
      for (const std::string& header : includes(entry.path())) {
        INFO(entry.path().string() << " includes " << header);
        CHECK(kForbidden.count(header) == 0);
        CHECK_FALSE(begins_with(header, "master/base/archive"));
      }
    }
  }
}

TEST_CASE("every source of the master and the units has a rule") {
  const fs::path root = STRIDE_SOURCE_DIR;
  for (const char* part : {"master", "units"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / part)) {
      if (!is_source(entry.path())) continue;
      const std::string file = entry.path().lexically_relative(root).string();
      INFO(file);
      CHECK(std::any_of(kAllowed.begin(), kAllowed.end(),
                        [&](const auto& rule) { return begins_with(file, rule.first); }));
    }
  }
}

TEST_CASE("the master has seven rooms and the report, and no crowded folder") {
  std::set<std::string> rooms;
  std::map<std::string, int> sources;
  const fs::path root = fs::path(STRIDE_SOURCE_DIR) / "master";
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (!is_source(entry.path())) continue;
    const fs::path file = entry.path().lexically_relative(root);
    rooms.insert(file.begin()->string());
    ++sources[file.parent_path().string()];
  }
  CHECK(rooms == std::set<std::string>{"base", "engine", "front", "loader", "observe", "report",
                                       "study", "system"});
  for (const auto& [folder, count] : sources) {
    INFO(folder);
    CHECK(count <= 30);
  }
}

TEST_CASE("the picture of the rooms in docs/architecture.md is that of these rules") {
  std::ifstream stream(fs::path(STRIDE_SOURCE_DIR) / "docs/architecture.md");
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  const std::string picture = picture_of_rooms();
  INFO("expected in docs/architecture.md:\n" << picture);
  CHECK(page.find(picture) != std::string::npos);
}

TEST_CASE("no headers and sources of the master include each other in a circle") {
  const Parts pairs = parts_of("master", &pair);
  CHECK(pairs.at("engine/run/stepping/stepper").count("engine/run/context/run_context") == 1);
  CHECK(circular(pairs).empty());
}

TEST_CASE("no folders of the master include each other in a circle") {
  const Parts folders = parts_of("master", &folder_of);
  CHECK(folders.at("engine/run/stepping").count("engine/run/context") == 1);
  CHECK(circular(folders).empty());
}

TEST_CASE("a circle is found with what leads to it") {
  CHECK(circular({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b", "d"}}, {"e", {"d"}}}) == "a b c ");
}

TEST_CASE("every header of the master is included by something other than its own source") {
  const fs::path root = STRIDE_SOURCE_DIR;
  std::map<std::string, std::set<std::string>> includers;
  for (const auto& entry : fs::recursive_directory_iterator(root / "master")) {
    if (!is_source(entry.path())) continue;
    const fs::path file = entry.path().lexically_relative(root);
    if (file.extension() == ".h") includers[file.string()];
    for (const std::string& header : includes(entry.path())) {
      const bool own = fs::path(header).replace_extension() == fs::path(file).replace_extension();
      if (begins_with(header, "master") && !own) includers[header].insert(file.string());
    }
  }
  CHECK(includers.size() > 100);
  for (const auto& [header, files] : includers) {
    INFO(header);
    CHECK_FALSE(files.empty());
  }
}

TEST_CASE("a unit's model does not include FMI") {
  const std::set<std::string> kWithoutFmi = {"stride/time.h",
                                             "stride/time_text.h",
                                             "stride/tangent.h",
                                             "stride/unit/state.h",
                                             "stride/unit/unit_of_measure_definition.h",
                                             "stride/value_type.h",
                                             "stride/value_text.h",
                                             "stride/variable_name.h",
                                             "stride/xml_text.h"};
  const fs::path root = STRIDE_SOURCE_DIR;
  for (const auto& entry : fs::recursive_directory_iterator(root / "units")) {
    const fs::path& path = entry.path();
    const bool glue = path.stem() == "unit";
    const bool kit = begins_with(path.lexically_relative(root).string(), "units/systemc");
    if (!is_source(path) || glue || kit) continue;
    for (const std::string& header : includes(path)) {
      INFO(path.lexically_relative(root).string() << " includes " << header);
      CHECK((header.rfind("stride/", 0) != 0 || kWithoutFmi.count(header) != 0));
    }
  }
}
