// A unit for a master elsewhere: its values, steps and promises.
#include <utility>

#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/loader/network/codec.h"
#include "master/loader/network/server/unit_server.h"

namespace stride::remote {

// ---- Values ----

void UnitServer::get(wire::Block::Reader block) {
  core::Unit& unit = this->unit();
  const isolation::StepShape::Group group = take_block(block, *description_);
  core::ValueBlock values(group.type, group.size);
  unit.get(group.references, values);
  answer([&](wire::Result::Builder result) { put_values(result.initValues(), values); });
}

void UnitServer::set(wire::Request::Set::Reader from) {
  core::Unit& unit = this->unit();
  const isolation::StepShape::Group group = take_block(from.getBlock(), *description_);
  core::ValueBlock values(group.type, group.size);
  take_values(from.getValues(), values);
  unit.set(group.references, values);
}

void UnitServer::get_directional_derivative(wire::Request::GetDirectionalDerivative::Reader from) {
  auto& derivatives = capability<core::DirectionalDerivatives>();
  const References unknowns = take_references(from.getUnknowns());
  const References knowns = take_references(from.getKnowns());
  std::vector<double> seed(element_count(knowns, *description_));
  take_doubles(from.getSeed(), seed);
  std::vector<double> sensitivity(element_count(unknowns, *description_));
  derivatives.get_directional_derivative(unknowns, knowns, seed, sensitivity);
  answer([&](wire::Result::Builder result) { result.setNumbers(to_data(sensitivity)); });
}

// ---- Steps ----

void UnitServer::make_plan(wire::Plan::Reader plan) {
  unit();
  if (plan.getNumber() >= plans_.size()) throw BadMessage("there is no such plan of a step");
  isolation::StepShape shape;
  for (const auto block : plan.getInputs()) {
    shape.inputs.push_back(take_block(block, *description_));
  }
  for (const auto block : plan.getOutputs()) {
    shape.outputs.push_back(take_block(block, *description_));
  }
  plans_[plan.getNumber()] = isolation::StepBuffers(shape);
}

void UnitServer::step(wire::Step::Reader from) {
  core::Unit& unit = this->unit();
  if (from.getPlan() >= plans_.size()) throw BadMessage("there is no such plan of a step");
  const core::StepValues values = plans_[from.getPlan()].values();
  take_values(from.getInputs(), values.inputs);
  const core::StepInterval interval = take_interval(from);
  time_ = interval.from;
  const core::StepResult result =
      from.getSavesState() ? capability<core::StateSaving>().save_with_step(unit, interval, values)
                           : unit.step(interval, values);
  if (!result.rejected) time_ = result.reached;
  answer([&](wire::Result::Builder to) {
    auto step = to.initStep();
    put_result(step, result);
    if (result.rejected) {
      step.setReason(diagnostics_->rejection_reason());
    } else {
      put_values(step.initOutputs(), values.outputs);
    }
  });
}

void UnitServer::set_input_update(bool is_set) {
  core::InputUpdate update;
  if (is_set) update = [this](double seconds) { request_inputs(seconds); };
  capability<core::InputsWithinStep>().set_input_update(std::move(update));
}

/// The master may get and set before it answers.
void UnitServer::request_inputs(double seconds_into_step) {
  const Clock::time_point began = began_;
  channel_.send([&](wire::Reply::Builder reply) { reply.setInputsNeeded(seconds_into_step); });
  for (;;) {
    IncomingMessage message(channel_.receive());
    const auto request = message.root<wire::Request>();
    if (request.isInputsUpdated()) break;
    if (request.isInputsNotUpdated()) throw CallbackFailure();
    serve(request);
    channel_.set_busy(true);
  }
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  began_ = began;
}

// ---- Idle time ----

void UnitServer::set_idle_tolerances(wire::Request::SetIdleTolerances::Reader from) {
  auto& promises = capability<core::IdlePromises>();
  const References outputs = take_references(from.getOutputs());
  const std::vector<double> tolerances = take_doubles(from.getTolerances());
  if (tolerances.size() != outputs.size()) throw BadMessage("tolerances are missing");
  promises.set_idle_tolerances(outputs, tolerances);
}

void UnitServer::get_derivatives(capnp::List<std::uint32_t>::Reader from) {
  auto& promises = capability<core::IdlePromises>();
  const References outputs = take_references(from);
  std::vector<double> derivatives(element_count(outputs, *description_));
  promises.get_derivatives(outputs, derivatives);
  answer([&](wire::Result::Builder result) { result.setNumbers(to_data(derivatives)); });
}

}  // namespace stride::remote
