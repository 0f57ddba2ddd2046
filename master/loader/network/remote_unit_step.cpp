// The steps of a unit on another machine.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "master/loader/network/codec.h"
#include "master/loader/network/remote_unit.h"

namespace stride::remote {

core::StepResult RemoteUnit::step(const core::StepInterval& interval) {
  return step(interval, core::StepValues{});
}

core::StepResult RemoteUnit::step(const core::StepInterval& interval,
                                  const core::StepValues& values) {
  begin_step(interval, values, {});
  return finish_step();
}

core::StepResult RemoteUnit::save_with_step(core::Unit& unit, const core::StepInterval& interval,
                                            const core::StepValues& values) {
  if (&unit != this) return StateSaving::save_with_step(unit, interval, values);
  times_.now = interval.from;
  begin_step(interval, values, {.saves_state = true});
  times_.note_saved();
  return finish_step();
}

void RemoteUnit::begin_step(const core::StepInterval& interval, const core::StepValues& values,
                            const Extras& extras) {
  const std::uint32_t plan = plan_number(values);
  times_.now = interval.from;
  send("a step", [&](wire::Request::Builder request) {
    auto step = request.initStep();
    step.setPlan(plan);
    put_interval(step, interval);
    step.setSavesState(extras.saves_state);
    put_values(step.initInputs(), values.inputs);
  });
  step_ = PresentStep{interval, values};
}

core::StepResult RemoteUnit::finish_step() {
  const PresentStep step = *std::exchange(step_, std::nullopt);
  waited_from_ = Clock::now();
  core::StepResult result;
  receive([&](wire::Result::Reader from) {
    if (!from.isStep()) throw BadMessage("an answer of another kind");
    const auto ended = from.getStep();
    result = take_result(ended, step.interval);
    if (result.rejected) {
      rejection_reason_ = to_string(ended.getReason());
    } else {
      take_values(ended.getOutputs(), step.values.outputs);
    }
  });
  if (!result.rejected) times_.now = result.reached;
  return result;
}

/// Another unit has failed, and its error ends the run. A step that does not end is no reason to
/// wait for ever.
void RemoteUnit::drop_step() noexcept {
  if (!std::exchange(step_, std::nullopt)) return;
  try {
    const auto limit = host_.call_limit.value_or(options_.warn_after);
    guard([&] {
      const auto end = Clock::now() + limit;
      for (bool is_result = false; !is_result;) {
        const auto rest =
            std::max(0ms, std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()));
        const auto reply = connection_->receive(rest);
        if (!reply) connection_->fail_bad_message("its step does not end");
        if (reply->isInputsNeeded()) {
          input_update_.set([](double) { throw std::runtime_error("its step is dropped"); });
        }
        take_reply(*reply, is_result);
      }
    });
  } catch (const std::exception& failure) {
    log(importer::Status::Warning, "stride",
        fmt::format("its step was dropped, since another unit had failed: {}", failure.what()));
  }
}

std::uint32_t RemoteUnit::plan_number(const core::StepValues& values) {
  if (const auto known = plans_.find(values)) return *known;
  const std::uint32_t number = plans_.add(values);
  defer([&](wire::Request::Builder request) {
    auto plan = request.initMakePlan();
    plan.setNumber(number);
    auto inputs = plan.initInputs(static_cast<unsigned>(values.inputs.size()));
    for (unsigned i = 0; i < inputs.size(); ++i) {
      put_block(inputs[i], values.inputs[i].references, *values.inputs[i].block);
    }
    auto outputs = plan.initOutputs(static_cast<unsigned>(values.outputs.size()));
    for (unsigned i = 0; i < outputs.size(); ++i) {
      put_block(outputs[i], values.outputs[i].references, *values.outputs[i].block);
    }
  });
  return number;
}

void RemoteUnit::set_input_update(core::InputUpdate update) {
  input_update_.set(std::move(update));
  defer([&](wire::Request::Builder request) { request.setSetInputUpdate(input_update_.is_set()); });
}

}  // namespace stride::remote
