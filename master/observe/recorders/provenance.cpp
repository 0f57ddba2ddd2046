#include "master/observe/recorders/provenance.h"

#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/base/text/shell_word.h"

namespace stride::recorders {
namespace {

namespace fs = std::filesystem;

/// Files may have been moved, but folders of one run have files of the same name in the same order.
using SourceKey = std::tuple<std::string, fs::path, std::size_t>;
using SourcesByKey = std::map<SourceKey, const Source*>;

SourcesByKey by_key(const Provenance& provenance) {
  SourcesByKey sources;
  for (const Source& source : provenance.sources) {
    if (source.what == kBranchesFile) continue;
    SourceKey key{source.what, source.path.filename(), 0};
    while (sources.contains(key)) ++std::get<std::size_t>(key);
    sources.emplace(std::move(key), &source);
  }
  return sources;
}

}  // namespace

std::string shell_text(const std::vector<std::string>& words) {
  std::string text = "stride";
  for (const std::string& word : words) text += " " + core::shell_word(word);
  return text;
}

Source make_source(std::string what, const fs::path& path, core::FileDigests& digests) {
  return {std::move(what), fs::absolute(path), digests.of(path)};
}

std::vector<std::string> differences(const Provenance& before, const Provenance& now) {
  std::vector<std::string> texts;
  if (before.version != now.version) {
    texts.push_back(fmt::format("it is of stride {}, and this is {}", before.version, now.version));
  }
  const SourcesByKey earlier = by_key(before);
  const SourcesByKey later = by_key(now);
  for (const auto& [key, source] : earlier) {
    const auto found = later.find(key);
    if (found == later.end()) {
      texts.push_back(
          fmt::format("{}, {}, is not used any more", source->what, source->path.string()));
    } else if (found->second->sha256 != source->sha256) {
      texts.push_back(
          fmt::format("{}, {}, is not what it was", source->what, found->second->path.string()));
    }
  }
  for (const auto& [key, source] : later) {
    if (earlier.contains(key)) continue;
    texts.push_back(fmt::format("{}, {}, was not used", source->what, source->path.string()));
  }
  return texts;
}

nlohmann::ordered_json to_json(const Provenance& provenance) {
  nlohmann::ordered_json sources = nlohmann::ordered_json::array();
  for (const Source& source : provenance.sources) {
    sources.push_back(
        {{"what", source.what}, {"path", source.path.string()}, {"sha256", source.sha256}});
  }
  nlohmann::ordered_json commands = nlohmann::ordered_json::array();
  for (const Command& command : provenance.commands) {
    commands.push_back({{"text", shell_text(command.words)},
                        {"words", command.words},
                        {"folder", command.folder.string()}});
  }
  return {{"version", provenance.version}, {"date", provenance.date},
          {"host", provenance.host},       {"commands", std::move(commands)},
          {"swaps", provenance.swaps},     {"values", provenance.values},
          {"sources", std::move(sources)}};
}

Provenance provenance_of(const nlohmann::ordered_json& json) {
  Provenance provenance{
      .version = json.at("version"), .date = json.at("date"), .host = json.at("host")};
  for (const nlohmann::ordered_json& command : json.at("commands")) {
    provenance.commands.push_back({command.at("words").get<std::vector<std::string>>(),
                                   command.at("folder").get<std::string>()});
  }
  provenance.swaps = json.value("swaps", std::vector<std::string>{});
  provenance.values = json.value("values", std::vector<std::string>{});
  for (const nlohmann::ordered_json& source : json.at("sources")) {
    provenance.sources.push_back(
        {source.at("what"), source.at("path").get<std::string>(), source.at("sha256")});
  }
  return provenance;
}

}  // namespace stride::recorders
