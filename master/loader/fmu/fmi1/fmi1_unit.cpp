#include "master/loader/fmu/fmi1/fmi1_unit.h"

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "master/base/time_text.h"
#include "master/loader/fmu/instance/printf_text.h"

namespace stride::importer {
namespace {

constexpr const char* kFmi1LastSuccessfulTime = "fmiLastSuccessfulTime";

}  // namespace

// ---- Life cycle ----

Fmi1Unit::Fmi1Unit(std::string name, std::shared_ptr<const Fmi1Library> library,
                   std::shared_ptr<const Fmi1Attributes> attributes, UnitParts parts,
                   InstanceOptions options)
    : ScalarUnit("fmi", library->functions(), attributes->references, library, std::move(name),
                 std::move(parts), std::move(options)),
      library_(std::move(library)),
      attributes_(std::move(attributes)) {
  constexpr const char* kMimeType = "application/x-fmu-sharedlibrary";
  constexpr double kNoTimeout = 0;
  const fmi1CallbackFunctions callbacks{&on_log, &std::calloc, &std::free, nullptr};
  instantiate_by("fmiInstantiateSlave", [&] {
    return fmi_.InstantiateSlave(name_.c_str(), parts_.description->instantiation_token.c_str(),
                                 parts_.resources.c_str(), kMimeType, kNoTimeout, fmi1False,
                                 fmi1False, callbacks,
                                 options_.debug_logging ? fmi1True : fmi1False);
  });
}

Fmi1Unit::~Fmi1Unit() {
  free_or_warn([this] { Fmi1Unit::free(); });
}

void Fmi1Unit::free() {
  if (instance_ != nullptr) free_instance_by("fmiFreeSlaveInstance", fmi_.FreeSlaveInstance);
}

core::Capability* Fmi1Unit::find_capability(core::CapabilityId id) {
  if (!declares(id)) return nullptr;
  return id == core::UnitDiagnostics::kId ? diagnostics() : implemented(id);
}

void Fmi1Unit::enter_initialization(Time start, std::optional<Time> stop) {
  time_ = start;
  const double stop_seconds = set_stop(start, stop);
  call_and_end_watch("fmiInitializeSlave", fmi_.InitializeSlave, to_seconds(start),
                     static_cast<fmi1Boolean>(stop.has_value()), stop_seconds);
}

void Fmi1Unit::terminate() {
  if (!has_failed()) call("fmiTerminateSlave", fmi_.TerminateSlave);
}

void Fmi1Unit::reset() {
  reset_by("fmiResetSlave", fmi_.ResetSlave);
  is_new_step_ = true;
}

/// The first argument is the component, which stride does not know before it is there.
void Fmi1Unit::on_log(fmi1Component component, fmi1String, fmi1Status status, fmi1String category,
                      fmi1String message, ...) {
  std::va_list arguments;
  va_start(arguments, message);
  try {
    const std::string text = message != nullptr ? printf_text(message, arguments) : "";
    with_receiver<Fmi1Unit>(component, [&](Fmi1Unit& unit) {
      unit.receive(status_of(status), category, unit.with_names(text).c_str());
    });
  } catch (...) {  // nothing may cross the unit's C code
  }
  va_end(arguments);
}

// ---- Values ----

void Fmi1Unit::get(References references, core::ValueBlock& values) {
  ScalarUnit::get(references, values);
  if (has_negated(references)) negate(references, values);
}

void Fmi1Unit::set(References references, const core::ValueBlock& values) {
  if (!has_negated(references)) return ScalarUnit::set(references, values);
  core::ValueBlock negated = values;
  negate(references, negated);
  ScalarUnit::set(references, negated);
}

bool Fmi1Unit::has_negated(References references) const {
  return std::ranges::any_of(references, [&](auto r) { return attributes_->negated[r]; });
}

void Fmi1Unit::negate(References references, core::ValueBlock& values) const {
  const auto apply = [&](auto elements, auto&& negative) {
    for (std::size_t i = 0; i < references.size(); ++i) {
      if (attributes_->negated[references[i]]) elements[i] = negative(elements[i]);
    }
  };
  switch (values.type()) {
    case core::ValueType::Float64:
      return apply(values.numbers<double>(), [](double value) { return 0 - value; });  // no "-0"
    case core::ValueType::Int32:  // the least has no negative
      return apply(values.numbers<std::int32_t>(), [](std::int32_t value) {
        return static_cast<std::int32_t>(0U - static_cast<std::uint32_t>(value));
      });
    case core::ValueType::Boolean:
      return apply(values.numbers<bool>(), std::logical_not<>());
    default:
      return;
  }
}

// ---- Steps ----

core::StepResult Fmi1Unit::step(const core::StepInterval& interval,
                                const core::StepValues& values) {
  CallSequence calls(*this, "fmiDoStep", interval.from);
  for (const core::BoundValues& input : values.inputs) set(input.references, *input.block);
  const double size = size_of(interval);
  core::StepResult result{.reached = interval.to};
  if (size > 0) {  // else it is the same instant to the unit, whose time is a double
    const fmi1Boolean is_new = is_new_step_ ? fmi1True : fmi1False;
    const Status status =
        calls.call_discardable("fmiDoStep", fmi_.DoStep, interval.begin_seconds, size, is_new);
    if (status == Status::Pending) fail("fmiDoStep returned fmiPending, which is not supported");
    is_new_step_ = true;
    if (status == Status::Discard) result = handle_discard(interval);
    if (result.rejected) return result;
  }
  calls.set_time(result.reached);
  for (const core::BoundValues& output : values.outputs) get(output.references, *output.block);
  return result;
}

core::StepResult Fmi1Unit::handle_discard(const core::StepInterval& interval) {
  take_rejection_reason("fmiDoStep");
  const std::optional<double> seconds = last_successful_time();
  const auto reached = instant_within(interval, seconds, kFmi1LastSuccessfulTime);
  if (reached && *reached > interval.from) {
    return {.early_return = *reached != interval.to, .reached = *reached};
  }
  if (attributes_->can_reject_steps) {
    is_new_step_ = false;
    return {.rejected = true, .reached = interval.from};
  }
  fail_discarded(interval, "fmiDoStep returned fmiDiscard",
                 how_far(interval, seconds, kFmi1LastSuccessfulTime),
                 "it cannot repeat a step (canRejectSteps)", "try a smaller step (--step)");
}

std::optional<double> Fmi1Unit::last_successful_time() {
  if (fmi_.GetRealStatus == nullptr) return std::nullopt;
  double seconds = 0;
  const Status status =
      call_discardable("fmiGetRealStatus", fmi_.GetRealStatus, fmi1LastSuccessfulTime, &seconds);
  if (has_messages()) drop_messages();
  const bool is_known = status == Status::Ok || status == Status::Warning;
  return is_known ? std::optional(seconds) : std::nullopt;
}

}  // namespace stride::importer
