#include "master/loader/network/server/unit_offer.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/base/error.h"
#include "master/base/files/untrusted_folder.h"

namespace stride::remote {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLimitHint = "have it served with a larger --file-limit";

bool is_plain_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." &&
         name.find_first_of(std::string_view("/\0", 2)) == std::string::npos && name.size() < 200;
}

}  // namespace

UnitOffer::UnitOffer(std::vector<std::string> only, std::optional<std::uint64_t> file_limit,
                     Find find)
    : file_limit_(file_limit), find_(std::move(find)) {
  for (std::string& name : only) {
    fs::path found = find_(name);
    only_.push_back({std::move(name), std::move(found)});
  }
}

fs::path UnitOffer::path(const std::string& name) const {
  if (only_.empty()) {
    if (!name.empty()) return find_(name);
    core::fail_input({}, "no FMU is named, and more than one is offered there");
  }
  if (name.empty() && only_.size() == 1) return only_.front().path;
  std::vector<std::string> names;
  for (const Offered& offered : only_) {
    const std::string own = offered.path.filename().string();
    if (name == offered.name || name == own) return offered.path;
    names.push_back(own);
  }
  core::fail_input({}, fmt::format("'{}' is not offered there", name),
                   fmt::format("what is offered: {}", core::quoted(names)));
}

std::shared_ptr<importer::Fmu> UnitOffer::fmu(const std::string& name) {
  const fs::path wanted = sent_ ? sent_->path : path(name);
  if (!fmu_ || loaded_ != wanted) {
    fmu_.reset();
    fmu_ = sent_ ? importer::Fmu::load(wanted, {}, wanted.filename(),
                                       {.bytes = *file_limit_, .hint = kLimitHint})
                 : importer::Fmu::load(wanted);
    loaded_ = wanted;
  }
  return fmu_;
}

void UnitOffer::take_piece(const std::string& name, std::string_view bytes, bool is_first) {
  if (!file_limit_) {
    core::fail_input({}, "no files are accepted there",
                     "name an FMU of that machine (fmu=\"…\"), or have it served with "
                     "--accept-files");
  }
  if (!is_plain_name(name) || (!is_first && !sent_)) {
    core::fail_input({}, fmt::format("'{}' is not the name of a file", name));
  }
  if (is_first) {
    sent_ = std::make_unique<Sent>();
    sent_->path = sent_->folder.path() / name;
  }
  sent_->size += bytes.size();
  if (sent_->size > *file_limit_) {
    sent_.reset();
    core::fail_input({}, fmt::format("'{}' has more than {} bytes", name, *file_limit_),
                     kLimitHint);
  }
  errno = 0;
  const core::FileStream file(std::fopen(sent_->path.c_str(), is_first ? "wxb" : "ab"),
                              &std::fclose);
  const bool is_written = file &&
                          std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                          std::fflush(file.get()) == 0;
  if (is_written) return;
  const int reason = errno;
  throw core::EnvironmentError({}, fmt::format("'{}' cannot be written there: {}", name,
                                               std::generic_category().message(reason)));
}

}  // namespace stride::remote
