// Dependencies run one way. Targets keep it at link time; this keeps it for headers.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

namespace fs = std::filesystem;

namespace {

/// Folder -> the folders and libraries whose headers it may include, beside its own and the
/// standard library's.
const std::map<std::string, std::set<std::string>> kAllowed = {
    {"interfaces", {"stride"}},
    {"master/util",
     {"stride/time.h", "stride/value_text.h", "stride/xml_text.h", "fmt", "iconv.h", "tinyxml2.h",
      "utf8.h", "archive.h", "archive_entry.h", "sha2.h", "zlib.h"}},
    {"master/model",
     {"stride/time.h", "stride/unit_of_measure.h", "stride/value_type.h", "master/util", "fmt"}},
    {"master/algorithm", {"stride/time.h", "master/model", "master/util", "fmt", "Eigen"}},
    {"master/importer",
     {"stride/time.h", "stride/fmi1.h", "stride/fmi2.h", "stride/fmi3.h", "stride/idle.h",
      "stride/describe.h", "stride/self_description.h", "stride/xml_text.h", "master/algorithm",
      "master/model", "master/util", "fmt"}},
    {"master/isolation",
     {"stride/time.h", "master/importer", "master/algorithm", "master/model", "master/util", "fmt",
      "seccomp.h"}},
    {"master/isolation/process", {"stride/time.h", "master/util", "fmt", "seccomp.h"}},
    {"master/remote",
     {"stride/time.h", "master/isolation", "master/importer", "master/algorithm", "master/model",
      "master/util", "fmt", "capnp", "remote.capnp.h"}},
    {"master/ssp", {"stride/time.h", "stride/xml_text.h", "master/model", "master/util", "fmt"}},
    {"master/checkpoint",
     {"stride/time.h", "master/recorders", "master/algorithm", "master/model", "master/util", "fmt",
      "nlohmann", "zlib.h"}},
    {"master/checks", {"stride/time.h", "master/algorithm", "master/model", "master/util", "fmt"}},
    {"master/coverage",
     {"stride/time.h", "master/algorithm", "master/model", "master/util", "fmt", "nlohmann"}},
    {"master/recorders",
     {"stride/time.h", "stride/value_text.h", "master/algorithm", "master/model", "master/util",
      "fmt", "nlohmann"}},
    {"master/scenario",
     {"stride/time.h", "master/ssp", "master/checks", "master/coverage", "master/recorders",
      "master/remote", "master/isolation", "master/importer", "master/algorithm", "master/model",
      "master/util", "fmt", "spdlog"}},
    {"master/campaign",
     {"stride/time.h", "master/scenario", "master/coverage", "master/ssp", "master/report",
      "master/recorders", "master/algorithm", "master/model", "master/util", "boost/math",
      "boost/random", "Random123", "fmt", "nlohmann"}},
    {"master/search", {"stride/time.h", "master/campaign", "master/util", "pagmo", "fmt"}},
    {"master/replay",
     {"stride/time.h", "master/scenario", "master/ssp", "master/importer", "master/model",
      "master/util", "fmt"}},
    {"master/capture",
     {"stride/time.h", "master/recorders", "master/algorithm", "master/model", "master/util",
      "fmt"}},
    {"master/report",
     {"stride/value_text.h", "master/recorders", "master/coverage", "master/algorithm",
      "master/model", "master/util", "fmt", "nlohmann", "zlib.h"}},
    {"master/compare",
     {"stride/time.h", "stride/value_text.h", "master/report", "master/recorders",
      "master/coverage", "master/model", "master/util", "fmt", "nlohmann"}},
    {"master/trace", {"stride/time.h", "master/util", "fmt"}},
    {"master/verify",
     {"stride/time.h", "master/importer", "master/isolation/process", "master/algorithm",
      "master/model", "master/util", "fmt", "nlohmann", "malloc.h"}},
    {"master/results",
     {"stride/time.h", "master/report", "master/checkpoint", "master/scenario", "master/recorders",
      "master/checks", "master/coverage", "master/ssp", "master/algorithm", "master/model",
      "master/util", "fmt", "spdlog"}},
    {"master/settings",
     {"stride/time.h", "master/scenario", "master/ssp", "master/util", "fmt", "spdlog", "CLI"}},
    {"master/api",
     {"stride/time.h", "stride/master.h", "master/results", "master/settings", "master/checkpoint",
      "master/scenario", "master/recorders", "master/algorithm", "master/model", "master/util",
      "fmt", "spdlog", "CLI"}},
    {"master/cli",
     {"stride/time.h", "master", "boost/asio.hpp", "boost/beast", "fmt", "nlohmann", "spdlog",
      "CLI", "arpa", "netinet", "stdio_ext.h"}},
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

/// A folder, or a header with its source beside the folders.
std::string folder_or_pair(const fs::path& file) {
  return file.has_parent_path() ? file.begin()->string() : file.stem().string();
}

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

TEST_CASE("the algorithm, the model and the checks open no files and load no libraries") {
  const std::set<std::string> kForbidden = {"filesystem", "fstream", "dlfcn.h", "fcntl.h",
                                            "unistd.h"};
  const fs::path root = fs::path(STRIDE_SOURCE_DIR) / "master";
  for (const char* folder : {"algorithm", "model", "checks"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!is_source(entry.path())) continue;
      for (const std::string& header : includes(entry.path())) {
        INFO(entry.path().string() << " includes " << header);
        CHECK(kForbidden.count(header) == 0);
        CHECK_FALSE(begins_with(header, "master/util/archive"));
      }
    }
  }
}

TEST_CASE("every folder with sources has a rule") {
  const fs::path root = STRIDE_SOURCE_DIR;
  for (const char* part : {"master", "units"}) {
    for (const auto& entry : fs::directory_iterator(root / part)) {
      if (!entry.is_directory()) continue;
      INFO(entry.path().string());
      CHECK(kAllowed.count(entry.path().lexically_relative(root).string()) == 1);
    }
  }
}

TEST_CASE("no headers and sources of the master include each other in a circle") {
  const Parts pairs = parts_of("master", &pair);
  CHECK(pairs.at("algorithm/stepping/stepper").count("algorithm/run_context") == 1);
  CHECK(circular(pairs).empty());
}

TEST_CASE("no parts of a folder of the master include each other in a circle") {
  CHECK(parts_of("master/algorithm", &folder_or_pair).at("stepping").count("run_context") == 1);
  for (const auto& entry : fs::directory_iterator(fs::path(STRIDE_SOURCE_DIR) / "master")) {
    if (!entry.is_directory()) continue;
    const std::string folder = "master/" + entry.path().filename().string();
    INFO(folder);
    CHECK(circular(parts_of(folder, &folder_or_pair)).empty());
  }
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
  const std::set<std::string> kWithoutFmi = {
      "stride/time.h",          "stride/tangent.h",
      "stride/unit/state.h",    "stride/unit/unit_of_measure_definition.h",
      "stride/value_type.h",    "stride/value_text.h",
      "stride/variable_name.h", "stride/xml_text.h"};
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
