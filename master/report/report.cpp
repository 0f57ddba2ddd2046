#include "master/report/report.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/untrusted_folder.h"
#include "master/base/message_text.h"
#include "master/observe/coverage/coverage_json.h"
#include "master/report/page.h"
#include "master/report/page_data.h"
#include "master/report/page_file.h"
#include "master/report/world_file.h"

namespace stride::report {
namespace {

namespace fs = std::filesystem;

/// Components of nested systems have points in their names, so the longest one counts.
std::string_view component_of(std::string_view signal,
                              const std::set<std::string_view>& components) {
  if (components.empty()) return signal.substr(0, signal.find('.'));
  for (std::size_t dot = signal.rfind('.'); dot != signal.npos && dot > 0;
       dot = signal.rfind('.', dot - 1)) {
    if (components.contains(signal.substr(0, dot))) return signal.substr(0, dot);
  }
  return "";
}

std::string title(std::string_view component, const Column& column) {
  const std::string whose(component.empty() ? "outputs" : component);
  if (!core::is_real(column.type())) return fmt::format("{}: states and counts", whose);
  return core::with_unit(whose, column.unit());
}

/// Writes the members of the data, one after the other, so that no two large ones are in memory.
class DataWriter {
 public:
  DataWriter(Sink& file, const Results& results)
      : file_(file), results_(results), folder_(results.folder) {}

  void write() {
    member("run", json_text(with_exact_integers(results_.run.json)));
    member("notes", json_text(results_.notes));
    write_signals(file_, results_.signals);
    member("plots", json_text(plots(results_)));
    list("messages", results_.messages, [&](const RecordedMessage& message) { write(message); });
    list("activity", results_.activities, [&](const UnitActivities& entry) { write(entry); });
    list("films", results_.films, [&](const Film& film) { write(film); });
    write_worlds();
    if (results_.coverage) member("coverage", json_text(coverage::to_json(*results_.coverage)));
    member("diagram", json_text(diagram(results_.run)));
  }

 private:
  void member(const char* name, const std::string& text) { write_member(file_, name, text); }

  template <class Entries, class Write>
  void list(const char* name, const Entries& entries, Write&& write_entry) {
    member(name, "[");
    bool is_first = true;
    for (const auto& entry : entries) {
      if (!std::exchange(is_first, false)) file_.write(',');
      write_entry(entry);
    }
    file_.write(']');
  }

  void write(const RecordedMessage& message) {
    file_.write(json_text({{"time", fmt::to_string(message.time.time_since_epoch().count())},
                           {"index", message.index},
                           {"component", message.component},
                           {"variable", message.variable},
                           {"direction", message.direction},
                           {"payload", message.payload},
                           {"content", message.content}}));
  }

  void write(const UnitActivities& entry) {
    file_.write(fmt::format(R"({{"component":{},"kind":{},"from":{},"until":{}}})",
                            json_text(entry.component), json_text(entry.kind),
                            blob(std::span(entry.from)), blob(std::span(entry.until))));
  }

  void write(const Film& film) {
    file_.write(fmt::format(R"({{"component":{},"times":{})", json_text(film.component),
                            blob(std::span(film.times))));
    list("frames", film.pictures, [&](const fs::path& picture) { write_picture(picture); });
    file_.write('}');
  }

  void write_picture(const fs::path& picture) {
    const std::string bytes = read(picture, kLargestPicture, "picture");
    const bool is_png = picture.extension() == ".png";
    file_.write(is_png ? "\"data:image/png;base64," : "\"data:image/jpeg;base64,");
    file_.write(base64({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}));
    file_.write('"');
  }

  /// With what draws them, which is nearly as large as the rest of the page.
  void write_worlds() {
    if (results_.worlds.empty()) return;
    list("worlds", results_.worlds, [&](const World& world) {
      const std::string bytes = read(world.file, kLargestWorld, "world");
      file_.write(fmt::format(R"({{"component":{},"file":)", json_text(world.component)));
      file_.write(
          blob(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size())));
      file_.write('}');
    });
    member("world_script", std::string(world_script()));
  }

  std::string read(const fs::path& path, std::size_t most, const char* what) const {
    auto bytes = folder_.read(path, most);
    if (bytes) return std::move(*bytes);
    core::fail_input({.where = {(results_.folder / path).string(), 0}},
                     fmt::format("cannot read the {}", what));
  }

  static Json plots(const Results& results) {
    std::vector<recorders::Plot> plots = results.run.plots;
    if (plots.empty()) plots = default_plots(results.signals.columns, results.run.components);
    Json entries = Json::array();
    for (const recorders::Plot& plot : plots) {
      entries.push_back({{"title", plot.title}, {"signals", plot.signals}});
    }
    return entries;
  }

  static Json diagram(const RunFile& run) {
    Json components = Json::array();
    for (const auto& [name, model] : run.components) {
      components.push_back({{"name", name}, {"model", model}});
    }
    Json connections = Json::array();
    for (const auto& [from, to, kind] : run.connections) {
      connections.push_back({{"from", from}, {"to", to}, {"kind", kind}});
    }
    return {{"components", components}, {"connections", connections}};
  }

  Sink& file_;
  const Results& results_;
  const core::UntrustedFolder folder_;
};

std::string_view elements_of(const Results& results) {
  return results.worlds.empty() ? std::string_view("") : world_licences();
}

}  // namespace

std::vector<recorders::Plot> default_plots(std::span<const Column> columns,
                                           std::span<const RunFile::Component> components) {
  std::vector<recorders::Plot> plots;
  std::map<std::string, std::size_t> places;  // by title
  std::set<std::string_view> names;
  for (const RunFile::Component& component : components) names.insert(component.name);
  for (const Column& column : columns) {
    const std::string wanted = title(component_of(column.name(), names), column);
    const auto [place, is_new] = places.emplace(wanted, plots.size());
    if (is_new) plots.push_back({wanted, {}});
    plots[place->second].signals.push_back(column.name());
  }
  return plots;
}

void write_report(const fs::path& file, const Results& results, const std::string& version) {
  write_page(
      file, page(), version, [&](Sink& output) { DataWriter(output, results).write(); },
      elements_of(results));
}

std::string live_report(const Results& results, const std::string& version) {
  constexpr std::string_view kPolicy = R"(<meta http-equiv="Content-Security-Policy")"
                                       "\n"
                                       R"(  content=")";
  std::string html(page());
  if (const std::size_t at = html.find(kPolicy); at != html.npos) {
    html.insert(at + kPolicy.size(), "connect-src 'self'; ");
    html.insert(at, "<meta name=\"stride-live\">\n");
  }
  return page_text(
      html, version, [&](Sink& output) { DataWriter(output, results).write(); },
      elements_of(results));
}

}  // namespace stride::report
