#include "master/report/run_file.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/text/readable_text.h"
#include "master/observe/recorders/results_folder.h"

namespace stride::report {
namespace {

/// The type with this name; an unknown one is text.
core::ValueType type_of(const std::string& text) {
  for (std::size_t i = 0; i < core::kValueTypeCount; ++i) {
    if (core::name(static_cast<core::ValueType>(i)) == text) return static_cast<core::ValueType>(i);
  }
  return core::ValueType::String;
}

/// An object of the file, whose members have the types that stride gives them. Throws
/// std::invalid_argument, which names the place of what is missing or has another type.
class Object {
 public:
  Object(const Json& json, std::string place) : json_(json), place_(std::move(place)) {
    require(json.is_object(), json, place_, "an object");
  }

  std::string text(const char* name) const {
    const Json* const found = find(name);
    if (found != nullptr) return text_of(*found, member(name));
    throw std::invalid_argument(fmt::format("'{}' is missing", member(name)));
  }
  std::string text_or(const char* name, const char* otherwise) const {
    const Json* const found = find(name);
    return found == nullptr ? otherwise : text_of(*found, member(name));
  }
  std::vector<std::string> texts(const char* name) const {
    std::vector<std::string> texts;
    for_each_entry(name, [&](const Json& entry, const std::string& place) {
      texts.push_back(text_of(entry, place));
    });
    return texts;
  }
  /// Calls visit(Object) for each entry of a list; there is none where the list is missing.
  template <class Visit>
  void for_each(const char* name, Visit&& visit) const {
    for_each_entry(
        name, [&](const Json& entry, const std::string& place) { visit(Object(entry, place)); });
  }
  std::optional<Object> object(const char* name) const {
    const Json* const found = find(name);
    return found == nullptr ? std::nullopt : std::optional(Object(*found, member(name)));
  }

 private:
  static void require(bool is_good, const Json& found, const std::string& place,
                      const char* expected) {
    if (is_good) return;
    throw std::invalid_argument(fmt::format("{} is of the type {}, expected {}",
                                            place.empty() ? "its root" : fmt::format("'{}'", place),
                                            found.type_name(), expected));
  }
  static std::string text_of(const Json& json, const std::string& place) {
    require(json.is_string(), json, place, "a text");
    return json.get<std::string>();
  }
  template <class Visit>
  void for_each_entry(const char* name, Visit&& visit) const {
    const Json* const found = find(name);
    if (found == nullptr) return;
    require(found->is_array(), *found, member(name), "a list");
    for (std::size_t i = 0; i < found->size(); ++i) {
      visit((*found)[i], fmt::format("{}[{}]", member(name), i));
    }
  }
  const Json* find(const char* name) const {
    const auto found = json_.find(name);
    return found == json_.end() ? nullptr : &*found;
  }
  std::string member(const char* name) const {
    return place_.empty() ? name : fmt::format("{}.{}", place_, name);
  }

  const Json& json_;
  std::string place_;
};

void read_files(const Object& run, recorders::ResultFiles& files) {
  const std::optional<Object> names = run.object("files");
  if (!names) return;
  for (const auto& [what, member] : recorders::kResultFiles) {
    const std::string name = names->text_or(what, "");
    if (!recorders::is_plain_file_name(name)) {
      throw std::invalid_argument(fmt::format("'{}' is not a file of this folder", name));
    }
    files.*member = name;
  }
}

void read_entries(RunFile& run) {
  const Object root(run.json, "");
  read_files(root, run.files);
  root.for_each("signals", [&](const Object& entry) {
    run.signals.push_back({entry.text("name"), entry.text("unit"), type_of(entry.text("type")),
                           entry.text("variability") == core::name(core::Variability::Continuous)});
  });
  root.for_each("units", [&](const Object& entry) {
    run.components.push_back({entry.text("name"), entry.text("model")});
  });
  root.for_each("connections", [&](const Object& entry) {
    run.connections.push_back(
        {entry.text("from"), entry.text("to"), entry.text_or("kind", "value")});
  });
  root.for_each("plots", [&](const Object& entry) {
    run.plots.push_back({entry.text("title"), entry.texts("signals")});
  });
}

/// What is nested any deeper was not written by stride, and would take its stack.
/// This is seen in the text, since the time that the library takes for a list of objects grows with
/// the square of its length where a callback is called for them.
void refuse_depth(std::string_view text) {
  constexpr int kDeepest = 64;
  int depth = 0;
  bool is_in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_in_string = !is_in_string;
    if (c == '\\' && is_in_string) ++i;  // what follows is part of the string
    if (is_in_string) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > kDeepest) throw std::length_error("it is nested too deeply");
  }
}

/// What is wrong at this place, counted from 1; the library's own words are for programmers.
std::string reason_at(std::string_view text, std::size_t place) {
  if (place == 0 || place > text.size()) return "the text ends too early";
  text.remove_prefix(place - 1);
  const std::string_view character = core::take_character(text);
  if (character == core::kReplacement) return "a byte that is not UTF-8";
  return fmt::format("'{}' is not expected here", core::readable_text(character, 1));
}

[[noreturn]] void fail(const std::filesystem::path& file, std::ptrdiff_t line,
                       const std::string& message) {
  core::fail_input({.where = {file.string(), static_cast<int>(line)}}, message,
                   "run the scenario again");
}

[[noreturn]] void fail_syntax(const std::filesystem::path& file, const std::string& text,
                              const Json::parse_error& mistake) {
  if (text.empty()) fail(file, 1, "this is not JSON: the file is empty");
  const std::string_view before = std::string_view(text).substr(0, mistake.byte);
  const std::size_t begin = before.rfind('\n') + 1;  // 0 in the first line
  fail(file, 1 + std::count(before.begin(), before.end(), '\n'),
       fmt::format("this is not JSON, in column {}: {}", before.size() - begin,
                   reason_at(text, mistake.byte)));
}

/// Thousands of signals take a few MiB.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;

bool is_run_file(const std::filesystem::path& file) {
  try {
    return read_run_file(file).files.statistics == file.filename();
  } catch (const core::Error&) {
    return false;
  }
}

}  // namespace

RunFile read_run_file(const std::filesystem::path& file) {
  constexpr const char* kOther = "this is not what `stride run` writes: {}";
  const std::string text = core::read_input(file, "", kMostBytes);
  try {
    refuse_depth(text);
    RunFile run{Json::parse(text)};
    read_entries(run);
    return run;
  } catch (const Json::parse_error& mistake) {
    fail_syntax(file, text, mistake);
  } catch (const Json::exception&) {
    fail(file, 0, fmt::format(kOther, "a number in it is out of range"));
  } catch (const std::logic_error& mistake) {
    fail(file, 0, fmt::format(kOther, mistake.what()));
  }
}

std::filesystem::path find_run_file(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path usual = folder / recorders::ResultFiles().statistics;
  if (std::filesystem::exists(usual, error)) return usual;
  for (const std::filesystem::path& other : core::folder_entries(folder)) {
    if (other.extension() == ".json" && is_run_file(other)) return other;
  }
  return {};
}

}  // namespace stride::report
