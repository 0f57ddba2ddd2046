#include "master/report/results.h"

#include <cerrno>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/input_file.h"
#include "master/base/files/untrusted_folder.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/observe/recorders/results_folder.h"
#include "master/observe/recorders/unit_folders.h"
#include "master/report/notes.h"
#include "master/report/table.h"
#include "master/report/world_file.h"

namespace stride::report {
namespace {

namespace fs = std::filesystem;

std::vector<RecordedMessage> read_messages(const fs::path& file, std::size_t limit, Notes& notes) {
  MessageRows rows(file);
  std::vector<RecordedMessage> messages;
  if (rows.table().columns().empty()) return messages;
  std::size_t count = 0;
  const auto unread = rows.table().for_each_row([&] {
    if (++count <= limit) messages.push_back(rows.message());
    return true;
  });
  notes.add_unread(file, unread);
  if (count > limit) {
    notes.add(file, fmt::format("the first {} of {} messages are shown", limit, count));
  }
  notes.add_cut(file, rows.table().cut());
  return messages;
}

std::vector<UnitActivities> read_activities(const fs::path& file, Notes& notes) {
  Table table(file);
  std::vector<UnitActivities> all;
  if (table.columns().empty()) return all;
  const std::size_t time = table.place("time");
  const std::size_t until = table.place("until");
  const std::size_t component = table.place("component");
  const std::size_t kind = table.place("kind");
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  const auto unread = table.for_each_row([&] {
    const Time from = table.time(time);
    const Time to = table.time(until);
    if (to < from) table.fail(until, "it ends before it begins");
    const std::pair key(table.field(component).value(), table.field(kind).value());
    const auto [place, is_new] = places.try_emplace(key, all.size());
    if (is_new) all.push_back({key.first, key.second, {}, {}});
    UnitActivities& activities = all[place->second];
    activities.from.push_back(from);
    activities.until.push_back(to);
    return true;
  });
  notes.add_unread(file, unread);
  notes.add_cut(file, table.cut());
  return all;
}

/// The pictures of a film that can be shown, and what is wrong with the others.
class FilmReader {
 public:
  /// `path`: of the film in the results folder.
  FilmReader(const core::UntrustedFolder& results, const fs::path& path, const Limits& limits)
      : results_(results), path_(path), limits_(limits) {}

  /// The list is open.
  void read(core::FileStream list, Film& film) {
    Table table(core::CsvReader(results_.path() / path_ / recorders::kFilmList, std::move(list)));
    if (table.columns().empty()) return;
    const std::size_t time = table.place("time");
    const std::size_t file = table.place("file");
    unread_ = table.for_each_row([&] {
      const fs::path picture = path_ / fs::path(table.field(file).value()).filename();
      const Time at = table.time(time);
      if (!film.times.empty() && at <= film.times.back()) {
        table.fail(time, "the time does not grow");
      }
      if (is_full()) return false;
      if (!is_shown(picture)) return true;
      film.times.push_back(at);
      film.pictures.push_back(picture);
      return true;
    });
    cut_ = table.cut();
  }

  void report(const Film& film, Notes& notes) const {
    const fs::path list = results_.path() / path_ / recorders::kFilmList;
    notes.add_unread(list, unread_);
    if (missing_ > 0) notes.add(list, fmt::format("{} of its pictures are missing", missing_));
    if (refused_ > 0) {
      notes.add(list, fmt::format("{} of its pictures are left out: they are links, no regular "
                                  "files, or larger than {} MiB",
                                  refused_, kLargestPicture >> 20));
    }
    if (is_cut_short_) {
      notes.add(list, fmt::format("the first {} of its pictures are shown", film.times.size()));
    }
    notes.add_cut(list, cut_);
  }

 private:
  bool is_shown(const fs::path& picture) {
    const auto size = results_.size(picture);
    if (size && *size <= kLargestPicture) {
      bytes_ += *size;
      return true;
    }
    ++(!size && errno == ENOENT ? missing_ : refused_);
    return false;
  }

  /// A unit that is alive may write the list without an end.
  bool is_full() {
    is_cut_short_ = ++rows_ > limits_.pictures || bytes_ > limits_.picture_bytes;
    return is_cut_short_;
  }

  const core::UntrustedFolder& results_;
  const fs::path path_;
  const Limits& limits_;
  std::size_t rows_ = 0;
  std::size_t missing_ = 0;
  std::size_t refused_ = 0;
  std::uintmax_t bytes_ = 0;
  bool is_cut_short_ = false;
  std::optional<Table::Unread> unread_;
  std::optional<std::size_t> cut_;
};

/// A folder's name may be too long to contain all of it.
std::string component_of(const std::string& unit_folder,
                         const std::vector<RunFile::Component>& components) {
  for (const auto& [name, model] : components) {
    if (recorders::unit_folder_name(name) == unit_folder) return name;
  }
  return recorders::component_of_folder(unit_folder);
}

std::vector<Film> read_films(const fs::path& folder, const RunFile& run, const Limits& limits,
                             Notes& notes) {
  const core::UntrustedFolder results(folder);
  std::vector<Film> films;
  for (const fs::path& unit : core::folder_entries(folder / recorders::kUnitsFolder)) {
    const fs::path name = unit.filename();
    const fs::path path = recorders::kUnitsFolder / name / recorders::kFilmFolder;
    core::FileStream list = results.open(path / recorders::kFilmList);
    if (!list) {
      // ENOTDIR: of a file in place of one of the folders, as of a link
      if (errno != ENOENT) {
        notes.add(folder / path, "left out: it is a link, or its list is no regular file");
      }
      continue;
    }
    Film film;
    film.component = component_of(name.string(), run.components);
    FilmReader reader(results, path, limits);
    try {
      reader.read(std::move(list), film);
    } catch (const core::Error& mistake) {
      notes.add_unread(folder / path / recorders::kFilmList, mistake);
    }
    reader.report(film, notes);
    if (!film.times.empty()) films.push_back(std::move(film));
  }
  return films;
}

std::vector<World> read_worlds(const fs::path& folder, const RunFile& run, Notes& notes) {
  const core::UntrustedFolder results(folder);
  std::vector<World> worlds;
  for (const fs::path& unit : core::folder_entries(folder / recorders::kUnitsFolder)) {
    const fs::path name = unit.filename();
    const fs::path path = recorders::kUnitsFolder / name / recorders::kWorldFile;
    const auto size = results.size(path);
    if (!size && (errno == ENOENT || errno == ENOTDIR)) continue;
    const core::FileStream file = results.open(path);
    const std::string mistake = size && file ? mistake_in_world(file.get(), *size)
                                             : std::string("it is a link, or no regular file");
    if (mistake.empty()) {
      worlds.push_back({component_of(name.string(), run.components), path});
    } else {
      notes.add(folder / path, fmt::format("left out: {}", mistake));
    }
  }
  return worlds;
}

/// The file, if it was to be written; where there is none that could be read, that is noted.
std::optional<fs::path> present(const fs::path& folder, const std::string& name, Notes& notes) {
  if (name.empty()) return std::nullopt;
  std::error_code error;
  const fs::path file = folder / name;
  if (fs::is_regular_file(file, error)) return file;
  notes.add(file, fs::exists(file, error) ? "this is not a regular file" : "this file is missing");
  return std::nullopt;
}

/// At its end a run has written their headers.
void note_empty(const fs::path& folder, const recorders::ResultFiles& files, const RunFile& run,
                Notes& notes) {
  const auto outcome = run.json.find("outcome");
  if (outcome == run.json.end() || *outcome == "running") return;
  for (const std::string& name : {files.signals, files.events, files.activity}) {
    std::error_code error;
    if (name.empty() || fs::file_size(folder / name, error) != 0 || error) continue;
    notes.add(folder / name, "the file is empty, without the header that its run has written");
  }
}

/// What read(file) returns; nothing where there is no such file or it cannot be read, which is
/// noted: the other files are whole without it.
template <class Read>
auto read_present(const fs::path& folder, const std::string& name, Notes& notes, Read&& read)
    -> decltype(read(folder)) {
  const auto file = present(folder, name, notes);
  if (!file) return {};
  try {
    return read(*file);
  } catch (const core::Error& mistake) {
    notes.add_unread(*file, mistake);
    return {};
  }
}

/// Nothing where the scenario has none.
std::optional<coverage::Report> read_coverage(const fs::path& folder, const std::string& name,
                                              Notes& notes) {
  const fs::path file = folder / name;
  std::error_code error;
  if (name.empty() || !fs::exists(file, error)) return std::nullopt;
  try {
    return coverage::read_coverage(file);
  } catch (const core::Error& mistake) {
    notes.add_unread(file, mistake);
    return std::nullopt;
  }
}

/// Those that run.json names, if it can be read.
recorders::ResultFiles named_files(const fs::path& run) {
  recorders::ResultFiles files;
  try {
    files = read_run_file(run).files;
  } catch (const core::Error&) {  // noted where the results are read
  }
  files.statistics = run.filename().string();
  return files;
}

}  // namespace

Results read_results(const fs::path& folder, const recorders::ResultFiles& files,
                     const Limits& limits, RunState state) {
  Results results;
  results.folder = folder;
  Notes notes(folder, state == RunState::GoingOn);
  results.run = read_present(folder, files.statistics, notes, &read_run_file);
  note_empty(folder, files, results.run, notes);
  if (const auto file = present(folder, files.signals, notes)) {
    results.signals = read_signals(*file, results.run.signals, limits.signals, notes);
  }
  results.messages = read_present(folder, files.events, notes, [&](const fs::path& file) {
    return read_messages(file, limits.messages, notes);
  });
  results.activities = read_present(folder, files.activity, notes, [&](const fs::path& file) {
    return read_activities(file, notes);
  });
  results.films = read_films(folder, results.run, limits, notes);
  results.worlds = read_worlds(folder, results.run, notes);
  results.coverage = read_coverage(folder, files.coverage, notes);
  results.notes = notes.texts();
  return results;
}

recorders::ResultFiles result_files(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    core::fail_input({.where = {folder.string(), 0}}, "this is not a folder",
                     "name a folder with the results of `stride run`");
  }
  if (const fs::path run = find_run_file(folder); !run.empty()) return named_files(run);
  const recorders::ResultFiles usual;
  for (const auto& [what, member] : recorders::kResultFiles) {
    if (what != std::string_view("report") && fs::exists(folder / (usual.*member), error)) {
      return usual;
    }
  }
  core::fail_input({.where = {folder.string(), 0}}, "there are no results in this folder",
                   "name a folder with the results of `stride run`");
}

}  // namespace stride::report
