// A unit for a master elsewhere: what it is, its beginning and its end.
#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "master/loader/network/codec.h"
#include "master/loader/network/description_files.h"
#include "master/loader/network/server/unit_server.h"
#include "master/loader/network/unit_files.h"
#include "master/loader/process/hosted_unit.h"

namespace stride::remote {
namespace {

/// The smaller of two limits, where there are some.
template <class T>
std::optional<T> least(std::optional<T> a, std::optional<T> b) {
  if (!a || !b) return a ? a : b;
  return std::min(*a, *b);
}

template <class T>
std::optional<T> above_zero(std::uint64_t number) {
  return number == 0 ? std::nullopt : std::optional<T>(number);
}

isolation::HostOptions host_options(wire::Instantiate::Reader from, const ServeOptions& options) {
  constexpr std::uint64_t kLongest = 1'000'000'000'000;  // [ms]
  isolation::HostOptions host;
  host.call_limit =
      least(above_zero<std::chrono::milliseconds>(std::min(from.getCallLimit(), kLongest)),
            options.call_limit);
  host.memory_limit = least(above_zero<std::uint64_t>(from.getMemoryLimit()), options.memory_limit);
  host.is_sandboxed = from.getIsSandboxed() || !options.may_leave_sandbox;
  host.takes_snapshots = from.getTakesSnapshots();
  return host;
}

std::optional<core::Interval> take_step(wire::Instantiate::Reader from) {
  if (!from.getStep().getIsThere()) return std::nullopt;
  const Duration rounded(from.getStep().getTime());
  const double seconds = from.getStepSeconds();
  const bool is_exact = std::isfinite(seconds) && seconds > 0;
  if (rounded <= Duration{}) throw BadMessage("a step has no such size");
  const auto step = is_exact ? core::Interval::from_seconds(seconds) : core::Interval(rounded);
  if (step.rounded() != rounded) throw BadMessage("a step has two sizes");
  return step;
}

/// Who offers some units only tells nothing of where they are.
std::string told_path(const UnitOffer& offer, const importer::Fmu& fmu) {
  return (offer.is_pinned() ? fmu.path().filename() : fmu.path()).string();
}

}  // namespace

core::Unit& UnitServer::unit() const {
  if (!unit_) throw BadMessage("a unit is called that is not there");
  return *unit_;
}

const core::Variable& UnitServer::variable(core::ValueReference reference) const {
  const auto found = description_ ? description_->find(reference) : std::nullopt;
  if (!found) throw BadMessage(fmt::format("the unit has no variable {}", reference));
  return description_->variables[*found];
}

core::Context UnitServer::context() const {
  return {.where = {}, .unit = name_, .variable = {}, .time = time_};
}

void UnitServer::describe(const std::string& name) {
  const auto fmu = offer_.fmu(name);
  const std::vector<importer::DescriptionFile> files = fmu->description_files();
  answer([&](wire::Result::Builder result) {
    auto description = result.initDescription();
    description.setPath(told_path(offer_, *fmu));
    auto list = description.initFiles(static_cast<unsigned>(files.size()));
    for (unsigned i = 0; i < list.size(); ++i) {
      list[i].setName(files[i].name);
      list[i].setBytes(to_data(files[i].text.data(), files[i].text.size()));
      list[i].setIsFirst(true);
    }
  });
}

/// As the master has it: arrays of the sizes that its structural parameters give.
std::shared_ptr<const core::UnitDescription> UnitServer::description_for(
    wire::Instantiate::Reader from) {
  const auto fmu = offer_.fmu(to_string(from.getFmu()));
  if (description_digest(fmu->description_files()) != to_string(from.getDigest())) {
    core::fail_input({.unit = name_},
                     fmt::format("'{}' there has changed since its description was read",
                                 told_path(offer_, *fmu)),
                     "start the run again");
  }
  auto description = std::make_shared<core::UnitDescription>(*fmu->description());
  for (const auto size : from.getSizes()) {
    if (!description->find(size.getParameter()) ||
        description->resize(size.getParameter(), size.getElements()) != nullptr) {
      throw BadMessage("an array has no such size");
    }
  }
  description->can_save_state &= from.getCanSaveState();
  description->can_serialize_state &= from.getCanSerializeState();
  return description;
}

void UnitServer::instantiate(wire::Instantiate::Reader from) {
  if (unit_) throw BadMessage("there is a unit already");
  name_ = to_string(from.getName());
  description_ = description_for(from);
  results_.emplace();
  importer::InstanceOptions options;
  options.early_return_allowed = from.getEarlyReturnAllowed();
  options.intermediate_update = from.getIntermediateUpdate();
  options.may_go_back = from.getMayGoBack();
  options.debug_logging = from.getDebugLogging();
  options.step = take_step(from);
  options.interrupted = &channel_.is_over();
  options.log = [this](const std::string&, importer::Status status, const std::string& category,
                       const std::string& text) {
    channel_.send([&](wire::Reply::Builder reply) {
      auto log = reply.initLog();
      log.setStatus(static_cast<std::uint8_t>(status));
      log.setCategory(category);
      log.setText(text);
    });
  };
  options.where = {to_string(from.getFile()), from.getLine()};
  options.results = results_->path();
  options.description = description_;
  isolation::HostOptions host = host_options(from, options_);
  host.writable.push_back(results_->path());
  unit_ = isolation::instantiate(offer_.fmu(to_string(from.getFmu())), name_, std::move(options),
                                 std::move(host));
  diagnostics_ = unit_->capability<core::UnitDiagnostics>();
  host_ = unit_->capability<core::HostDiagnostics>();
  isolation::CapabilitySet capabilities;
  for (std::size_t i = 0; i < capabilities.size(); ++i) {
    capabilities.set(i, unit_->capability(static_cast<core::CapabilityId>(i)) != nullptr);
  }
  answer([&](wire::Result::Builder result) {
    auto instance = result.initInstance();
    put_capabilities(instance, capabilities);
    put_protections(instance, host_->host_statistics());
  });
}

void UnitServer::free() {
  unit().free();
  answer();
}

void UnitServer::send_statistics() {
  unit();
  const core::HostStatistics statistics = host_->host_statistics();
  answer(
      [&](wire::Result::Builder result) { put_statistics(result.initStatistics(), statistics); });
}

/// Those that cannot be sent are said.
void UnitServer::send_files() {
  std::string left_out;
  if (results_) {
    left_out = read_unit_files(results_->path(),
                               [&](const std::string& name, std::string_view bytes, bool is_first) {
                                 channel_.send([&](wire::Reply::Builder reply) {
                                   auto piece = reply.initFile();
                                   piece.setName(name);
                                   piece.setBytes(to_data(bytes.data(), bytes.size()));
                                   piece.setIsFirst(is_first);
                                 });
                               });
  }
  answer([&](wire::Result::Builder result) { result.setText(left_out); });
}

}  // namespace stride::remote
