#include "master/loader/wire/dispatcher.h"

#include <chrono>
#include <tuple>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

namespace stride::isolation {
namespace {

constexpr std::size_t kMostStates = 1'000'000;

/// What take() makes of a parameter.
template <class P>
using Taken =
    decltype(Argument<P>::take(std::declval<PacketReader&>(), std::declval<ArgumentPlace&>()));

constexpr bool is_possible_in_step(RequestCode request) {
  return request == code_of<&core::Unit::get>() || request == code_of<&core::Unit::set>();
}

template <class... Arguments>
constexpr bool kHasReferences = (std::is_same_v<Arguments, std::vector<core::ValueReference>> ||
                                 ...);

class TrueWhile {
 public:
  explicit TrueWhile(bool& flag) : flag_(flag) { flag_ = true; }
  ~TrueWhile() { flag_ = false; }
  TrueWhile(const TrueWhile&) = delete;
  TrueWhile& operator=(const TrueWhile&) = delete;

 private:
  bool& flag_;
};

}  // namespace

Dispatcher::Dispatcher(core::InputUpdate request_inputs) {
  place_.request_inputs = std::move(request_inputs);
}

void Dispatcher::begin(core::Unit& unit, const core::UnitDescription& description,
                       core::StateSaving* states, bool checks_sizes) {
  unit_ = &unit;
  place_.description = &description;
  checks_sizes_ = checks_sizes;
  for (std::size_t i = 0; i < capabilities_.size(); ++i) {
    capabilities_[i] = unit.capability(static_cast<core::CapabilityId>(i));
  }
  if (states != nullptr) {
    capabilities_[static_cast<std::size_t>(core::StateSaving::kId)] = states;
  }
}

CapabilitySet Dispatcher::capabilities() const {
  CapabilitySet found;
  for (std::size_t i = 0; i < capabilities_.size(); ++i) found.set(i, capabilities_[i] != nullptr);
  return found;
}

core::Unit& Dispatcher::unit() const {
  if (unit_ == nullptr) throw BadPacket("a unit is called that is not there");
  return *unit_;
}

template <class Interface>
Interface& Dispatcher::target() const {
  if constexpr (std::is_same_v<Interface, core::Unit>) {
    return unit();
  } else {
    return capability<Interface>();
  }
}

// ---- Calls of the table ----

template <auto function>
void Dispatcher::call(PacketReader& in, PacketWriter& out) {
  using Traits = FunctionTraits<decltype(function)>;
  using Result = typename Traits::Result;
  auto& target = this->target<typename Traits::Interface>();
  const auto make = [&]<class... P>(std::type_identity<std::tuple<P...>>) {
    std::tuple<Taken<P>...> taken{Argument<P>::take(in, place_)...};
    in.require_end();
    const auto with = [&](auto&... arguments) {
      check<function>(arguments...);
      times_.note_begin<function>(arguments...);
      if constexpr (std::is_void_v<Result>) {
        (target.*function)(arguments...);
      } else {
        Form<Result>::put(out, (target.*function)(arguments...));
      }
      times_.note_end<function>(arguments...);
      (Argument<P>::put_back(out, arguments), ...);
    };
    std::apply(with, taken);
  };
  make(std::type_identity<typename Traits::Parameters>());
}

template <auto function, class... Arguments>
void Dispatcher::check(const Arguments&... arguments) const {
  if constexpr (is_same_function<function, &core::StateSaving::select_state>) {
    if (((arguments > kMostStates) || ...)) throw BadPacket("there is no such state");
  } else if constexpr (kHasReferences<Arguments...>) {
    check_sizes(arguments...);
  }
}

/// The function for each row of the table.
struct Rows {
  using Serve = void (Dispatcher::*)(PacketReader&, PacketWriter&);

  template <auto... functions>
  static constexpr auto serve_functions(const std::tuple<Call<functions>...>&) {
    return std::array<Serve, kCallCount>{&Dispatcher::call<functions>...};
  }
};

void Dispatcher::serve(RequestCode request, PacketReader& in, PacketWriter& out) {
  static constexpr auto kServe = Rows::serve_functions(kCalls);
  if (is_in_step_ && !is_possible_in_step(request)) {
    throw BadPacket("a request came in a step that none can make there");
  }
  if (request == RequestCode::Step) return step(in, out);
  if (request == RequestCode::MakePlan) return make_plan(in);
  if (row_of(request) >= kServe.size()) throw BadPacket("there is no such request");
  (this->*kServe[row_of(request)])(in, out);
}

// ---- Steps ----

void Dispatcher::make_plan(PacketReader& in) {
  unit();
  StepBuffers& made = plan(in.take<std::uint32_t>());
  const StepShape shape = take_step_shape(in);
  in.require_end();
  for (const auto* const groups : {&shape.inputs, &shape.outputs}) {
    for (const StepShape::Group& group : *groups) {
      check_block(group.references, group.type, group.size);
    }
  }
  made = StepBuffers(shape);
}

StepBuffers& Dispatcher::plan(std::uint32_t number) {
  if (number >= plans_.size()) throw BadPacket("there is no such plan of a step");
  return plans_[number];
}

void Dispatcher::step(PacketReader& in, PacketWriter& out) {
  core::Unit& unit = this->unit();
  const auto request = in.take<StepRequest>();
  StepBuffers& buffers = plan(request.plan);
  buffers.take_inputs(in);
  in.require_end();
  const core::StepInterval interval = request.interval();
  const core::StepValues values = buffers.values();
  times_.now = interval.from;
  core::StepResult result;
  {
    const TrueWhile stepping(is_in_step_);
    if (request.has(StepRequest::kSavesState)) {
      auto& states = capability<core::StateSaving>();
      times_.note_saved(interval.from);
      result = states.save_with_step(unit, interval, values);
    } else {
      result = unit.step(interval, values);
    }
  }
  if (!result.rejected) times_.now = result.reached;
  put_step(out, result);
  if (request.has(StepRequest::kIsTimed)) out.put(std::chrono::steady_clock::now());
  if (result.rejected) {
    out.put(capability<core::UnitDiagnostics>().rejection_reason());
  } else {
    buffers.put_outputs(out);
  }
}

// ---- Sizes ----

void Dispatcher::check_sizes(References references, const core::ValueBlock& values) const {
  check_block(references, values.type(), values.size());
}

void Dispatcher::check_sizes(References references, const FilledBlock& values) const {
  check_block(references, values.shape.type, values.shape.size);
}

void Dispatcher::check_sizes(References references, std::span<const double> one_each) const {
  if (one_each.size() != references.size()) throw BadPacket("numbers are missing, or too many");
}

void Dispatcher::check_sizes(References references, const FilledNumbers& numbers) const {
  if (checks_sizes_ && numbers.size != element_count(references)) {
    throw BadPacket("numbers are missing, or too many");
  }
}

void Dispatcher::check_sizes(References unknowns, References knowns, std::span<const double> seed,
                             const FilledNumbers& sensitivity) const {
  if (checks_sizes_ &&
      (seed.size() != element_count(knowns) || sensitivity.size != element_count(unknowns))) {
    throw BadPacket("numbers are missing, or too many");
  }
}

void Dispatcher::check_block(References references, core::ValueType type, std::size_t size) const {
  if (!checks_sizes_) return;
  for (const core::ValueReference reference : references) {
    if (place_.variable(reference).type != type) {
      throw BadPacket(
          fmt::format("the unit has no {} with the reference {}", core::name(type), reference));
    }
  }
  const std::size_t count = element_count(references);
  if (count == size) return;
  throw BadPacket(fmt::format("{} elements are named of variables that have {}", size, count));
}

std::size_t Dispatcher::element_count(References references) const {
  std::size_t size = 0;
  for (const core::ValueReference reference : references) {
    size += place_.variable(reference).size;
    if (size > core::kMaxElements) throw BadPacket("the values of a call are too many");
  }
  return size;
}

}  // namespace stride::isolation
