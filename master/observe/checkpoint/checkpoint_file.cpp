#include "master/observe/checkpoint/checkpoint_file.h"

#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "master/base/archive/unpacked_archive.h"
#include "master/base/archive/zip.h"
#include "master/base/error.h"
#include "master/base/files/descriptor.h"
#include "master/base/files/input_file.h"
#include "master/base/files/sha256.h"
#include "master/base/state_archive.h"
#include "master/base/time_text.h"

namespace stride::checkpoint {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Of what this version of stride writes: to be raised where states change.
constexpr int kFormat = 2;

constexpr const char* kDescription = "checkpoint.json";
constexpr const char* kDescriptionHash = "checkpoint.sha256";

constexpr std::uintmax_t kMostState = std::uintmax_t{4} << 30;  // [byte]

std::string_view text_of(const Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Json description(const Checkpoint& checkpoint) {
  Json units = Json::array();
  for (const auto& [component, kept] : checkpoint.units) {
    units.push_back({{"component", component}, {"state", kept}});
  }
  Json states = Json::array();
  for (const auto& [name, bytes] : checkpoint.states) {
    states.push_back(
        {{"name", name}, {"size", bytes.size()}, {"sha256", core::sha256(text_of(bytes))}});
  }
  return {{"stride checkpoint", kFormat},
          {"time", core::to_text(checkpoint.time)},
          {"results", checkpoint.results.string()},
          {"interventions", checkpoint.interventions},
          {"provenance", recorders::to_json(checkpoint.provenance)},
          {"units", std::move(units)},
          {"states", std::move(states)}};
}

/// Names of components may be any, those in an archive may not.
std::string entry_name(std::size_t index) { return fmt::format("states/{}", index); }

void put_on_disk(const fs::path& path, int how) {
  const core::Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | how));
  if (file.number() < 0 || ::fsync(file.number()) == 0) return;
  core::fail_run(
      {.where = {path.string(), 0}},
      fmt::format("cannot be put on the disk: {}", std::generic_category().message(errno)),
      "check the disk that it is on");
}

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  core::fail_input({.where = {file.string(), 0}}, what,
                   "name a checkpoint that 'stride run --checkpoint' has written");
}

Json read_description(const fs::path& file, const fs::path& folder) {
  if (!core::is_file(folder / kDescription)) {
    fail(file, fmt::format("this is no checkpoint: it has no {}", kDescription));
  }
  const std::string text = core::read_input(folder / kDescription);
  const Json json = Json::parse(text);
  const int format = json.at("stride checkpoint");
  if (format != kFormat) {
    fail(file, fmt::format("this checkpoint has the format {}, and this version of stride knows {}",
                           format, kFormat));
  }
  const fs::path hash = folder / kDescriptionHash;
  if (!core::is_file(hash) || core::read_input(hash) != core::sha256(text)) {
    fail(file, fmt::format("the checkpoint is damaged, or was changed: its {} is not what was "
                           "written",
                           kDescription));
  }
  return json;
}

Bytes read_state(const fs::path& file, const Json& state, const fs::path& path) {
  const std::string text = core::is_file(path) ? core::read_input(path, "", kMostState) : "";
  if (core::sha256(text) != state.at("sha256").get<std::string>()) {
    fail(file, fmt::format("the checkpoint is damaged: the state of '{}' is not what was written",
                           state.at("name").get<std::string>()));
  }
  const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
  return {bytes, bytes + text.size()};
}

Checkpoint read(const fs::path& file, const fs::path& folder) {
  const Json json = read_description(file, folder);
  Checkpoint checkpoint;
  checkpoint.provenance = recorders::provenance_of(json.at("provenance"));
  checkpoint.time = core::parse_time(json.at("time").get<std::string>());
  checkpoint.results = json.at("results").get<std::string>();
  checkpoint.interventions = json.at("interventions");
  for (const Json& unit : json.at("units")) {
    checkpoint.units[unit.at("component")] = unit.at("state");
  }
  std::size_t index = 0;
  for (const Json& state : json.at("states")) {
    checkpoint.states[state.at("name")] = read_state(file, state, folder / entry_name(index++));
  }
  return checkpoint;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  archive::Contents contents;
  contents[kDescription].text =
      description(checkpoint).dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  contents[kDescriptionHash].text = core::sha256(contents[kDescription].text);
  std::size_t index = 0;
  for (const auto& [name, bytes] : checkpoint.states) {
    contents[entry_name(index++)].text = text_of(bytes);
  }
  archive::write_zip(file, contents);
  put_on_disk(file, 0);
  put_on_disk(file.parent_path(), O_DIRECTORY);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  try {
    const archive::UnpackedArchive archive(file, "a checkpoint: a zip archive");
    return read(file, archive.folder());
  } catch (const core::Error& mistake) {
    throw core::Error(mistake.kind(), mistake.context(), mistake.message(),
                      "resume an earlier checkpoint, or let the run begin at its start");
  } catch (const nlohmann::json::exception& mistake) {
    fail(file, fmt::format("this is no checkpoint, or a damaged one: {}", mistake.what()));
  } catch (const std::invalid_argument& mistake) {  // a time
    fail(file, fmt::format("this is no checkpoint, or a damaged one: {}", mistake.what()));
  }
}

const Bytes& state_of(const Checkpoint& checkpoint, const std::string& name) {
  const auto found = checkpoint.states.find(name);
  if (found == checkpoint.states.end()) {
    throw core::BadState(fmt::format("it has no state of '{}'", name));
  }
  return found->second;
}

}  // namespace stride::checkpoint
