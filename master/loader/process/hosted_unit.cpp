#include "master/loader/process/hosted_unit.h"

#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "master/loader/process/host_client.h"
#include "master/loader/process/hosted_unit_spec.h"
#include "master/loader/wire/unit_proxy.h"

namespace stride::isolation {
namespace {

/// The shared memory as the carrier. Where its states are snapshots of the process, the server
/// there has StateSaving for it.
class HostedUnit final : public UnitProxy {
 public:
  /// Throws what the unit's own constructor throws.
  explicit HostedUnit(HostedUnitSpec spec);
  ~HostedUnit() override;

  void restore_state() override;
  void set_repeating(bool repeating) override { client_->set_repeating(repeating); }
  void free() override;
  std::uint64_t calls() const override { return client_->calls(); }
  core::HostStatistics host_statistics() const override;

 private:
  PacketWriter write() override { return client_->write(); }
  void post(RequestCode request, const PacketWriter& packet) override;
  Reply await(Patience patience) override;
  bool has_failed() const override { return client_->has_failed(); }
  void fail_bad_packet(const BadPacket& /*mistake*/) override { client_->fail_bad_packet(now()); }
  void warn(const std::string& text) const noexcept override {
    client_->log(importer::Status::Warning, "stride", text);
  }

  HostedUnitSpec spec_;
  std::unique_ptr<HostClient> client_;
  Protections protections_;
};

HostedUnit::HostedUnit(HostedUnitSpec spec)
    : UnitProxy(spec.options.where, spec.name,
                spec.host.call_limit.value_or(spec.options.warn_after)),
      spec_(std::move(spec)) {
  if (spec_.host.is_sandboxed) {
    spec_.temporary = std::make_unique<archive::TemporaryFolder>();
  }
  try {
    client_ = std::make_unique<HostClient>(spec_);
  } catch (const std::system_error& failure) {
    core::fail_run(context(), fmt::format("there can be no process for it: {}", failure.what()));
  }
  send(RequestCode::Instantiate, [](PacketWriter&) {});
  receive([&](PacketReader& from) {
    protections_ = Form<Protections>::take(from);
    set_capabilities(Form<CapabilitySet>::take(from));
  });
}

HostedUnit::~HostedUnit() {
  try {
    HostedUnit::free();
  } catch (const std::exception& failure) {
    warn(fmt::format("its end failed: {}", failure.what()));
  }
  client_->finish();
}

void HostedUnit::free() {
  if (is_freed()) return;
  UnitProxy::free();
  if (!has_failed()) client_->finish();
}

/// A process that is taken back knows the plans of its time only.
void HostedUnit::restore_state() {
  if (spec_.has_snapshots()) forget_plans();
  UnitProxy::restore_state();
}

core::HostStatistics HostedUnit::host_statistics() const {
  core::HostStatistics statistics = client_->statistics();
  statistics.protections = protections_.in_force;
  statistics.missing_protections = protections_.missing;
  return statistics;
}

void HostedUnit::post(RequestCode request, const PacketWriter& packet) {
  client_->post(request, packet, now());
  if (request == RequestCode::Step) client_->begin_call();
}

Reply HostedUnit::await(Patience patience) {
  const ReplyCode code = client_->await(now(), patience ? patience : spec_.host.call_limit);
  return {code, client_->read()};
}

}  // namespace

std::unique_ptr<core::Unit> instantiate(std::shared_ptr<importer::Fmu> fmu, const std::string& name,
                                        importer::InstanceOptions options, HostOptions host) {
  return std::make_unique<HostedUnit>(
      HostedUnitSpec{std::move(fmu), name, std::move(options), std::move(host)});
}

}  // namespace stride::isolation
