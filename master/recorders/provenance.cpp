#include "master/recorders/provenance.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "master/util/shell_word.h"

namespace stride::recorders {
namespace {

namespace fs = std::filesystem;

const Source* find(const Provenance& provenance, const std::string& what, const fs::path& name) {
  const auto found = std::ranges::find_if(provenance.sources, [&](const Source& source) {
    return source.what == what && source.path.filename() == name;
  });
  return found == provenance.sources.end() ? nullptr : &*found;
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
  for (const Source& source : before.sources) {
    const Source* const other = find(now, source.what, source.path.filename());
    if (other == nullptr) {
      texts.push_back(
          fmt::format("{}, {}, is not used any more", source.what, source.path.string()));
    } else if (other->sha256 != source.sha256) {
      texts.push_back(fmt::format("{}, {}, is not what it was", source.what, other->path.string()));
    }
  }
  for (const Source& source : now.sources) {
    if (find(before, source.what, source.path.filename()) != nullptr) continue;
    texts.push_back(fmt::format("{}, {}, was not used", source.what, source.path.string()));
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
