#include "master/loader/process/hosted_unit.h"

#include <utility>

#include "master/loader/process/unit_proxy.h"

namespace stride::isolation {

std::unique_ptr<core::Unit> instantiate(std::shared_ptr<importer::Fmu> fmu, const std::string& name,
                                        importer::InstanceOptions options, HostOptions host) {
  return std::make_unique<UnitProxy>(
      HostedUnitSpec{std::move(fmu), name, std::move(options), std::move(host)});
}

}  // namespace stride::isolation
