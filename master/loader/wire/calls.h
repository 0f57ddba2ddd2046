// The calls of the unit port as data: one table, from which the proxy of a unit elsewhere
// (unit_proxy.h), what carries out its requests where the unit is (dispatcher.h) and the words in
// errors are made.
//
// To add a call: a row here, and its function in UnitProxy, which the compiler asks for. Arguments
// and results of a type that no call had before need a form (arguments.h, codec.h). The number of a
// call is its place, so a change of the table raises kProtocol (network/greeting.h).
#ifndef STRIDE_MASTER_LOADER_WIRE_CALLS_H
#define STRIDE_MASTER_LOADER_WIRE_CALLS_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>
#include <utility>

#include "master/engine/port/capabilities/clock_intervals.h"
#include "master/engine/port/capabilities/configuration_mode.h"
#include "master/engine/port/capabilities/directional_derivatives.h"
#include "master/engine/port/capabilities/host_diagnostics.h"
#include "master/engine/port/capabilities/idle_promises.h"
#include "master/engine/port/capabilities/inputs_within_step.h"
#include "master/engine/port/capabilities/message_text.h"
#include "master/engine/port/capabilities/resetting.h"
#include "master/engine/port/capabilities/state_saving.h"
#include "master/engine/port/capabilities/state_serialization.h"
#include "master/engine/port/capabilities/unit_diagnostics.h"
#include "master/engine/port/unit.h"

namespace stride::isolation {

/// Whether the master waits for the end of a call where waiting is dear. What a deferred call
/// throws is thrown by the next one that is awaited.
enum class Wait : bool { Deferred, Awaited };

/// A function of core::Unit or of a capability: what the capability is, and which arguments and
/// results there are, follows from its type.
template <auto function>
struct Call {
  const char* words;  ///< what it is for, in errors of a link
  Wait wait = Wait::Awaited;
};

inline constexpr std::tuple kCalls{
    Call<&core::ConfigurationMode::enter_configuration_mode>{"the configuration mode",
                                                             Wait::Deferred},
    Call<&core::ConfigurationMode::exit_configuration_mode>{"the configuration mode"},
    Call<&core::Unit::enter_initialization>{"the initialization"},
    Call<&core::Unit::exit_initialization>{"the initialization"},
    Call<&core::Unit::get>{"the reading of values"},
    Call<&core::Unit::set>{"the setting of values", Wait::Deferred},
    Call<&core::Unit::enter_event_mode>{"an event", Wait::Deferred},
    Call<&core::Unit::update_discrete_states>{"an event"},
    Call<&core::Unit::enter_step_mode>{"an event", Wait::Deferred},
    Call<&core::Unit::terminate>{"its end"},
    Call<&core::Unit::free>{"its end"},
    Call<&core::StateSaving::save_state>{"the saving of its state", Wait::Deferred},
    Call<&core::StateSaving::restore_state>{"the restoring of its state", Wait::Deferred},
    Call<&core::StateSaving::select_state>{"the selection of a state", Wait::Deferred},
    Call<&core::StateSerialization::serialize_state>{"the serialization of its state"},
    Call<&core::StateSerialization::deserialize_state>{"the deserialization of its state"},
    Call<&core::Resetting::reset>{"the reset"},
    Call<&core::ClockIntervals::clock_interval>{"the interval of a clock"},
    Call<&core::ClockIntervals::clock_shift>{"the shift of a clock"},
    Call<&core::DirectionalDerivatives::get_directional_derivative>{"a derivative"},
    Call<&core::InputsWithinStep::set_input_update>{"inputs within steps", Wait::Deferred},
    Call<&core::IdlePromises::enable_idle_skipping>{"its idle promise", Wait::Deferred},
    Call<&core::IdlePromises::set_idle_tolerances>{"its idle promise", Wait::Deferred},
    Call<&core::IdlePromises::idle_until>{"its idle promise"},
    Call<&core::IdlePromises::get_derivatives>{"derivatives of outputs"},
    Call<&core::MessageText::describe_message>{"the text of a message"},
    Call<&core::UnitDiagnostics::set_repeating>{"repeated calls", Wait::Deferred},
    Call<&core::HostDiagnostics::host_statistics>{"its statistics"},
};
inline constexpr std::size_t kCallCount = std::tuple_size_v<decltype(kCalls)>;

/// What a request is: one of these, or a call with the number behind them that its row has.
enum class RequestCode : std::uint32_t {
  Instantiate,
  MakePlan,          ///< the shape of the values of steps (step_plan.h)
  Step,              ///< by such a plan, with the state saved before if that is asked for
  InputsUpdated,     ///< in answer to RequestInputs: the inputs are set
  InputsNotUpdated,  ///< likewise: that has failed
  FirstCall,
};

/// What the answer to a request is.
enum class ReplyCode : std::uint32_t {
  Done,
  Failed,          ///< a core::Error
  CallbackFailed,  ///< what failed is what the master did within the call
  RequestInputs,   ///< a question within a step; the reply to the step's request comes later
};

template <auto a, auto b>
inline constexpr bool is_same_function = std::is_same_v<Call<a>, Call<b>>;

template <auto function>
constexpr std::size_t row_of() {
  return []<class... Rows>(const std::tuple<Rows...>&) {
    std::size_t row = 0;
    (void)((std::is_same_v<Rows, Call<function>> || (++row, false)) || ...);
    static_assert((std::is_same_v<Rows, Call<function>> || ...), "the table lacks the call");
    return row;
  }(kCalls);
}

template <auto function>
constexpr RequestCode code_of() {
  return static_cast<RequestCode>(static_cast<std::size_t>(RequestCode::FirstCall) +
                                  row_of<function>());
}

/// The row of a request; kCallCount or more if it is no call.
constexpr std::size_t row_of(RequestCode request) {
  return static_cast<std::size_t>(request) - static_cast<std::size_t>(RequestCode::FirstCall);
}

/// What a request is for, in words.
constexpr const char* words_of(RequestCode request) {
  constexpr auto kWords = std::apply(
      [](const auto&... rows) { return std::array<const char*, kCallCount>{rows.words...}; },
      kCalls);
  if (request == RequestCode::Instantiate) return "the instantiation";
  return row_of(request) < kCallCount ? kWords[row_of(request)] : "a step";
}

/// What the type of a function says.
template <class Function>
struct FunctionTraits;
template <class C, class R, class... P>
struct FunctionTraits<R (C::*)(P...)> {
  using Interface = C;
  using Result = R;
  using Parameters = std::tuple<P...>;
};
template <class C, class R, class... P>
struct FunctionTraits<R (C::*)(P...) const> : FunctionTraits<R (C::*)(P...)> {};

}  // namespace stride::isolation

#endif
