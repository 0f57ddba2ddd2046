// FMUs of many kinds, in this process and in processes of their own: each goes on in another
// instance as if nothing had been.
#include <cstdlib>
#include <optional>

#include "tests/at.h"
#include "tests/error_of.h"
#include "tests/master/loader/process/support.h"
#include "tests/master/observe/checkpoint/rig.h"

using namespace stride;
using namespace stride::tests;
using Catch::Matchers::Contains;

namespace {

/// A unit, and how it is made and called.
struct Kind {
  std::string fmu;
  Driver::Values values{};
  Driver::Values structure{};
  std::string slip{};      ///< of fmi2_forgetter
  bool coasts = true;      ///< its steps may be repeated
  std::string kept{};      ///< the beginning of how its state is kept
  bool takes_snapshots{};  ///< where it is hosted
  bool hides_state{};      ///< as if it had none
};

std::vector<Kind> kinds() {
  return {
      {.fmu = "stepper",
       .values = {{"largest_step", "0.002"},
                  {"early_at", "0.0131"},
                  {"event_at", "0.007"},
                  {"tick_at", "0.02"},
                  {"logs", "true"}},
       .kept = "serialised"},
      {.fmu = "types", .kept = "serialised"},
      {.fmu = "rejecter",
       .values = {{"shortest", "0.0005"}, {"longest", "0.003"}, {"seed", "3"}},
       .kept = "serialised"},
      {.fmu = "rejecter_without_state",
       .values = {{"shortest", "0.0005"}, {"longest", "0.003"}, {"seed", "3"}},
       .kept = "replayed",
       .takes_snapshots = true},
      {.fmu = "early_without_state",
       .values = {{"instants", "0.0013 0.0101 0.0102 0.02 -1 -1 -1 -1"}, {"wants_events", "true"}},
       .kept = "replayed",
       .takes_snapshots = true},
      {.fmu = "ticker", .values = {{"period", "0.0017"}}, .kept = "serialised"},
      {.fmu = "clocks", .kept = "serialised"},
      {.fmu = "idler", .kept = "serialised"},
      {.fmu = "oscillator_mass", .kept = "serialised"},
      {.fmu = "tracer", .kept = "replayed"},
      {.fmu = "resizable", .structure = {{"n", "5"}}, .kept = "replayed"},
      {.fmu = "fmi1_tank", .kept = "replayed"},
      {.fmu = "fmi2_relaxation", .kept = "replayed"},
      {.fmu = "fmi2_relaxation_without_state", .kept = "replayed"},
      {.fmu = "fmi2_types", .kept = "replayed"},
      {.fmu = "fmi2_integrator", .kept = "replayed"},
      {.fmu = "fmi2_forgetter", .slip = "4", .coasts = false, .kept = "replayed"},
      {.fmu = "fmi2_forgetter", .slip = "10", .kept = "replayed", .hides_state = true},
  };
}

/// An instance, and what reaches its log.
struct Instance {
  Instance(const Kind& kind, std::shared_ptr<importer::Fmu> loaded, bool is_hosted)
      : fmu(std::move(loaded)) {
    auto sized = std::make_shared<core::UnitDescription>(*fmu->description());
    for (const auto& [name, text] : kind.structure) {
      sized->resize(sized->variables[*sized->find(name)].reference, std::stoul(text));
    }
    if (kind.hides_state) sized->can_save_state = sized->can_serialize_state = false;
    description = sized;
    importer::InstanceOptions options{.early_return_allowed = true,
                                      .intermediate_update = true,
                                      .may_go_back = true,
                                      .debug_logging = true,
                                      .description = description};
    options.log = [this](const std::string&, importer::Status, const std::string&,
                         const std::string& text) { log.push_back(text); };
    auto unit = is_hosted ? isolation::instantiate(fmu, "u", options,
                                                   {.takes_snapshots = kind.takes_snapshots})
                          : fmu->instantiate("u", options);
    rig.emplace(std::move(unit), description, kind.coasts);
  }

  std::shared_ptr<importer::Fmu> fmu;
  std::shared_ptr<const core::UnitDescription> description;
  std::vector<std::string> log;
  std::optional<Rig> rig;
};

void check_going_on(const Kind& kind, bool is_hosted, bool goes_on_hosted, unsigned seed) {
  CAPTURE(kind.fmu, kind.slip, is_hosted, goes_on_hosted, seed);
  ::setenv("STRIDE_TEST_SLIP", kind.slip.c_str(), 1);
  const auto fmu = importer::Fmu::load(test_fmu(kind.fmu));  // one: its folder is an output of some
  Instance first(kind, fmu, is_hosted);
  Driver driver(first.description, seed);
  const bool can_anywhere = first.description->can_save_state || is_hosted == goes_on_hosted;
  driver.goes_back = kind.coasts && can_anywhere;
  driver.structure = kind.structure;
  driver.start(**first.rig, kind.values);
  driver.advance(**first.rig, static_cast<int>(seed * 7 % 40));
  const std::vector<std::byte> bytes = first.rig->write();
  CHECK_THAT(to_text(first.rig->journaled->kept()), Catch::Matchers::StartsWith(kind.kept));

  Instance second(kind, fmu, goes_on_hosted);
  Driver other = driver;
  other.connect(**second.rig);
  second.rig->read(bytes);
  CHECK(second.log.empty());
  driver.advance(**first.rig, 20);
  other.advance(**second.rig, 20);
  check_same(driver.got, other.got);
}

}  // namespace

TEST_CASE("an FMU goes on in another instance as if nothing had been") {
  for (const Kind& kind : kinds()) {
    for (unsigned seed = 1; seed <= 6; ++seed) check_going_on(kind, false, false, seed);
  }
}

TEST_CASE("so does one in a process of its own, or there and then here") {
  for (const Kind& kind : kinds()) {
    check_going_on(kind, true, true, 5);
    check_going_on(kind, true, false, 3);
    check_going_on(kind, false, true, 4);
  }
}
