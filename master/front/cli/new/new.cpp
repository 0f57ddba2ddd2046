// stride new: the first files of a scenario or a unit.
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/error.h"
#include "master/base/files/output_file.h"
#include "master/base/files/program_root.h"
#include "master/base/text/shell_word.h"
#include "master/front/cli/new/starters.h"
#include "master/front/cli/program/commands.h"
#include "master/front/cli/program/output.h"

namespace stride::cli {
namespace {

namespace fs = std::filesystem;

struct NewRequest {
  std::string name;
  bool is_unit = false;
  bool is_systemc = false;
  fs::path folder;  ///< empty = the name

  Starter starter() const {
    if (is_systemc) return Starter::SystemcUnit;
    return is_unit ? Starter::Unit : Starter::Scenario;
  }
};

/// It is the name of files, of a target of CMake, and in FMI an identifier of C.
constexpr std::string_view kTaken[] = {
    "all",       "and",      "auto",     "bool",     "break",    "case",     "catch",   "char",
    "class",     "clean",    "const",    "continue", "default",  "delete",   "do",      "double",
    "else",      "enum",     "explicit", "export",   "extern",   "false",    "float",   "for",
    "friend",    "goto",     "help",     "if",       "inline",   "install",  "int",     "long",
    "main",      "mutable",  "new",      "not",      "operator", "or",       "package", "private",
    "protected", "public",   "register", "return",   "sc_core",  "sc_dt",    "short",   "signed",
    "sizeof",    "static",   "std",      "stride",   "struct",   "switch",   "systemc", "template",
    "test",      "this",     "throw",    "true",     "try",      "typedef",  "typeid",  "typename",
    "union",     "unsigned", "using",    "virtual",  "void",     "volatile", "while",   "xor"};

bool is_letter(char c) { return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z'); }

void check_name(const std::string& name) {
  constexpr std::size_t kLongest = 64;
  const bool is_plain =
      !name.empty() && is_letter(name.front()) && std::ranges::all_of(name, [](char c) {
        return is_letter(c) || ('0' <= c && c <= '9') || c == '_';
      });
  if (!is_plain || name.size() > kLongest || name.find("__") != std::string::npos) {
    core::fail_input({}, fmt::format("NAME is '{}'", name),
                     fmt::format("begin with a letter, go on with letters, digits and single '_', "
                                 "{} of them at most: room_heating",
                                 kLongest));
  }
  if (std::ranges::binary_search(kTaken, std::string_view(name))) {
    core::fail_input({}, fmt::format("NAME is '{}', which is a word of C++, CMake or stride", name),
                     "choose another one");
  }
}

/// room_heating -> RoomHeating
std::string class_name(const std::string& name) {
  std::string text;
  bool begins_word = true;
  for (const char c : name) {
    if (c != '_') text += begins_word ? static_cast<char>(std::toupper(c)) : c;
    begins_word = c == '_';
  }
  return text;
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
  return text;
}

std::string text_of(const StarterFile& file, const std::string& name) {
  const std::array<std::pair<std::string_view, std::string>, 3> words{
      {{"@NAME@", name}, {"@CLASS@", class_name(name)}, {"@VERSION@", STRIDE_VERSION}}};
  std::string text(file.text);
  for (const auto& [word, by] : words) text = replaced(std::move(text), word, by);
  return text;
}

/// Its folder has to be made, or to be empty.
void make_folder(const fs::path& folder) {
  std::error_code failure;
  if (fs::exists(folder, failure) &&
      (!fs::is_directory(folder, failure) || !fs::is_empty(folder, failure))) {
    core::fail_input({.where = {folder.string(), 0}}, "it is there already, and is no empty folder",
                     "choose another NAME, or another folder with --out");
  }
  fs::create_directories(folder, failure);
  if (!failure) return;
  core::fail_input({.where = {folder.string(), 0}},
                   fmt::format("cannot make the folder: {}", failure.message()),
                   "choose a folder in which you may write, with --out");
}

std::vector<std::string> write_files(const NewRequest& request, const fs::path& folder) {
  std::vector<std::string> written;
  for (const StarterFile& file : starter_files(request.starter())) {
    const fs::path path = folder / replaced(std::string(file.name), "NAME", request.name);
    core::OutputFile output(path, {.create = "choose a folder in which you may write, with --out"},
                            core::OutputFile::Existing::Refused);
    output.write(text_of(file, request.name));
    output.close();
    written.push_back(path.string());
  }
  return written;
}

/// What CMake has to be told to find this stride; empty where it looks by itself. A Python package
/// has no SystemC to build with.
std::string prefix_option(bool needs_systemc) {
  const fs::path prefix = core::program_root();
  if (prefix == "/usr" || prefix == "/usr/local") return "";
  std::error_code unknown;
  const char* const file = needs_systemc ? "stride-systemc.cmake" : "strideConfig.cmake";
  if (fs::exists(prefix / STRIDE_PACKAGE_FOLDER / file, unknown)) {
    return " " + core::shell_word("-DCMAKE_PREFIX_PATH=" + prefix.string());
  }
  return fmt::format(" -DCMAKE_PREFIX_PATH=FOLDER   # FOLDER: where stride is installed{}",
                     needs_systemc ? ", with its component systemc" : "");
}

void make_new(const NewRequest& request) {
  check_name(request.name);
  const fs::path folder = request.folder.empty() ? fs::path(request.name) : request.folder;
  make_folder(folder);
  const std::vector<std::string> written = write_files(request, folder);
  print_text("{}\n\nNext:\n  cd {}\n", fmt::join(written, "\n"), core::shell_word(folder.string()));
  if (request.starter() != Starter::Scenario) {
    print_text(
        "  cmake -B build{}\n  cmake --build build\n"
        "  ctest --test-dir build --output-on-failure\n",
        prefix_option(request.is_systemc));
  }
  print_text("  stride run {}.ssd\n", request.name);
}

}  // namespace

void add_new(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "new", "Write the first files of a scenario or a unit, which run as they are");
  const auto request = std::make_shared<NewRequest>();
  command->add_option("NAME", request->name, "What it is called: letters, digits and '_'")
      ->required()
      ->type_name("");
  CLI::Option* const unit = command->add_flag(
      "--unit", request->is_unit,
      "A unit in C++, with its build, a test, and a scenario that uses it; else a scenario alone");
  command->add_flag("--systemc", request->is_systemc, "Likewise, of a module of SystemC")
      ->excludes(unit);
  command
      ->add_option("--out,-o", request->folder,
                   "The folder, which is made; that of the name unless given")
      ->type_name("FOLDER");
  command->callback([request] { make_new(*request); });
}

}  // namespace stride::cli
