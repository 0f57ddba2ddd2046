// Each call of the table goes there and comes back, through packets as a carrier takes them.
#include "master/loader/wire/calls.h"

#include <catch2/catch.hpp>

#include "master/loader/wire/dispatcher.h"
#include "tests/error_of.h"
#include "tests/master/loader/wire/any_unit.h"

using namespace stride;
using namespace stride::isolation;
using namespace stride::tests;
using Catch::Matchers::Contains;
using core::ValueBlock;
using core::ValueType;

namespace {

using References = std::span<const core::ValueReference>;

constexpr core::ValueReference kIn[] = {0}, kOut[] = {1}, kText[] = {2}, kClock[] = {3};

ValueBlock numbers(std::initializer_list<double> values) {
  ValueBlock block(ValueType::Float64, values.size());
  std::copy(values.begin(), values.end(), block.numbers<double>().begin());
  return block;
}

/// A carrier to a dispatcher beside it.
class Loopback final : public UnitProxy {
 public:
  explicit Loopback(bool may_defer)
      : UnitProxy({"test.ssd", 7}, "u", std::chrono::seconds(1)), may_defer_(may_defer) {
    dispatcher_.begin(unit, description_, nullptr, true);
    set_capabilities(dispatcher_.capabilities());
  }

  AnyUnit unit;
  int awaited = 0;

  std::uint64_t calls() const override { return unit.calls(); }
  core::HostStatistics host_statistics() const override {
    return const_cast<Loopback*>(this)->fetch_statistics();
  }

 private:
  PacketWriter write() override { return PacketWriter(request_); }
  void post(RequestCode request, const PacketWriter& packet) override {
    PacketReader in(packet.bytes());
    PacketWriter out(reply_);
    code_ = ReplyCode::Done;
    try {
      dispatcher_.serve(request, in, out);
    } catch (const std::exception& error) {
      code_ = ReplyCode::Failed;
      put_error(out, error, {.unit = "u", .time = dispatcher_.time()});
    }
    size_ = out.size();
  }
  bool defer(RequestCode request, const PacketWriter& packet) override {
    if (may_defer_) post(request, packet);
    return may_defer_;
  }
  Reply await(Patience) override {
    ++awaited;
    return {code_, PacketReader({reply_.data(), size_})};
  }
  bool has_failed() const override { return false; }
  void fail_bad_packet(const BadPacket& mistake) override {
    core::fail_run(context(), mistake.what());
  }
  void warn(const std::string&) const noexcept override {}

  const core::UnitDescription description_ = any_description();
  Dispatcher dispatcher_{[](double) {}};
  bool may_defer_;
  PacketBuffer request_, reply_;
  ReplyCode code_ = ReplyCode::Done;
  std::size_t size_ = 0;
};

/// Requests of a master that is not trusted.
class Untrusted {
 public:
  AnyUnit unit;
  Dispatcher dispatcher{[](double) {}};

  Untrusted() { dispatcher.begin(unit, description_, nullptr, true); }

  template <class Put>
  std::string error(RequestCode request, Put&& put) {
    PacketBuffer memory, answer;
    PacketWriter packet(memory), out(answer);
    put(packet);
    PacketReader in(packet.bytes());
    return error_of([&] { dispatcher.serve(request, in, out); });
  }

 private:
  const core::UnitDescription description_ = any_description();
};

}  // namespace

TEST_CASE("modes, states and promises arrive with their arguments") {
  const bool may_defer = GENERATE(false, true);
  Loopback proxy(may_defer);
  proxy.enter_configuration_mode();
  proxy.exit_configuration_mode();
  proxy.enable_idle_skipping(Duration(9));
  proxy.set_idle_tolerances(kOut, std::vector{0.25});
  proxy.enter_initialization(Time(Duration(3)), std::nullopt);
  proxy.exit_initialization();
  proxy.enter_step_mode();
  proxy.select_state(2);
  proxy.save_state();
  proxy.restore_state();
  proxy.deserialize_state(std::vector<std::uint8_t>{4, 5});
  proxy.set_repeating(true);
  proxy.enter_event_mode();
  proxy.reset();
  proxy.terminate();
  proxy.free();
  CHECK((proxy.unit.log ==
         std::vector<std::string>{"enter_configuration_mode", "exit_configuration_mode",
                                  "enable_idle_skipping 9", "set_idle_tolerances [1] [0.25]",
                                  "enter_initialization 3 -1", "exit_initialization",
                                  "enter_step_mode", "select_state 2", "save_state",
                                  "restore_state", "deserialize_state [4, 5]", "set_repeating true",
                                  "enter_event_mode", "reset", "terminate", "free"}));
  CHECK(proxy.awaited == (may_defer ? 7 : 16));
}

TEST_CASE("values and results come back") {
  Loopback proxy(true);
  proxy.unit.output = 2.5;
  ValueBlock pair = numbers({0, 0}), text(ValueType::String, 1), clock(ValueType::Clock, 1);
  proxy.get(kIn, pair);
  CHECK((pair == numbers({2.5, 2.5})));
  proxy.get(kText, text);
  CHECK(text.strings()[0] == "read");
  proxy.get(kClock, clock);
  CHECK(clock.numbers<bool>()[0]);
  proxy.set(kIn, numbers({1, -4}));
  CHECK(proxy.unit.log.back() == "set [0] 1 -4");
  double derivative = 0, sensitivity = 0;
  proxy.get_derivatives(kOut, {&derivative, 1});
  CHECK(derivative == 2.5);
  proxy.get_directional_derivative(kOut, kIn, std::vector{1.0, 3.0}, {&sensitivity, 1});
  CHECK(proxy.unit.log.back() == "get_directional_derivative [1] [0] [1, 3]");
  CHECK(sensitivity == 2.5);
  CHECK(proxy.update_discrete_states().next_event_time == Time(Duration(7)));
  CHECK(proxy.idle_until() == Time(Duration(11)));
  CHECK((proxy.serialize_state() == std::vector<std::uint8_t>{1, 2, 3}));
  CHECK(proxy.describe_message(2, {8, 9}) == "2 has [8, 9]");
  CHECK(proxy.host_statistics().most_memory == 5);
  const core::UnitDescription description = any_description();
  CHECK((proxy.clock_interval(description.variables[3]).interval ==
         core::Interval::from_fraction(1, 3)));
  CHECK((proxy.clock_shift(description.variables[3]) == core::Interval::from_fraction(1, 7)));
}

TEST_CASE("a step keeps each bit of its interval, and has its values with it") {
  Loopback proxy(true);
  ValueBlock in = numbers({1, 2}), out = numbers({0});
  const core::BoundValues inputs[] = {{kIn, in}}, outputs[] = {{kOut, out}};
  core::StepInterval interval(Time(Duration(100)), 1.0000000000000002e-10, Time(Duration(350)),
                              3.5e-10, 2.5e-10);
  interval.may_go_back_before = true;
  proxy.unit.result = {.early_return = true, .reached = Time(Duration(200))};
  proxy.unit.output = 8;
  const core::StepResult result = proxy.save_with_step(proxy, interval, {inputs, outputs});
  CHECK(result.early_return);
  CHECK(result.reached == Time(Duration(200)));
  CHECK((out == numbers({8})));
  CHECK((proxy.unit.log == std::vector<std::string>{"set [0] 1 2", "save_state",
                                                    "step 100 350 2.5e-10 true", "get [1]"}));
  proxy.unit.result.rejected = true;
  proxy.unit.output = 9;
  CHECK(proxy.step(interval, {inputs, outputs}).rejected);
  CHECK((out == numbers({8})));
  CHECK(proxy.rejection_reason() == "too far");
  proxy.unit.result = {.reached = Time(Duration(351))};
  CHECK_THAT(error_of([&] { proxy.step(interval); }),
             Contains("test.ssd:7: unit 'u'") && Contains("has ended outside of itself"));
}

TEST_CASE("only variables that there are can be named, with the sizes that they have") {
  Untrusted peer;
  const auto error = [&](ValueType type, std::size_t size,
                         const std::vector<core::ValueReference>& references) {
    return peer.error(code_of<&core::Unit::get>(), [&](PacketWriter& to) {
      to.put_all(std::span(references));
      to.put(static_cast<std::uint8_t>(type));
      to.put(size);
    });
  };
  CHECK(error(ValueType::Float64, 4, {0, 0}) == "(no error)");
  CHECK_THAT(error(ValueType::Float64, std::size_t{1} << 60, {0}),
             Contains("are named of variables that have 2"));
  CHECK_THAT(error(ValueType::Float64, 1, {9}), Contains("no such variable"));
  CHECK_THAT(error(ValueType::Float64, 1, {2}), Contains("has no Float64 with the reference 2"));
  const auto endless = [](PacketWriter& to) {
    to.put_all(References(kOut));
    to.put(std::size_t{1} << 60);
  };
  CHECK_THAT(peer.error(code_of<&core::IdlePromises::get_derivatives>(), endless),
             Contains("numbers are missing, or too many"));
  CHECK_THAT(peer.error(code_of<&core::StateSaving::select_state>(),
                        [](PacketWriter& to) { to.put(~std::size_t{0}); }),
             Contains("there is no such state"));
  CHECK(peer.unit.log.size() == 1);
}

TEST_CASE("a request that is none, or too long, is refused") {
  Untrusted peer;
  const auto nothing = [](PacketWriter&) {};
  const auto more = [](PacketWriter& to) { to.put(1); };
  CHECK_THAT(peer.error(RequestCode{999}, nothing), Contains("no such request"));
  CHECK_THAT(peer.error(RequestCode::InputsUpdated, nothing), Contains("no such request"));
  CHECK_THAT(peer.error(code_of<&core::Unit::free>(), more), Contains("more than there should be"));
  CHECK_THAT(peer.error(code_of<&core::Unit::get>(), nothing), Contains("missing at the end"));
  CHECK_THAT(peer.error(RequestCode::Step, more), Contains("missing at the end"));
  CHECK(peer.unit.log.empty());
}

TEST_CASE("within a step values are set and read, and nothing else is done") {
  Untrusted peer;
  std::string set_error, plan_error;
  peer.unit.update = [&](double) {
    const ValueBlock values = numbers({1, 2});
    set_error = peer.error(code_of<&core::Unit::set>(), [&](PacketWriter& to) {
      to.put_all(References(kIn));
      put_shape(to, values);
      put_values(to, values);
    });
    plan_error = peer.error(RequestCode::MakePlan, [](PacketWriter&) {});
  };
  const auto put_plan = [](PacketWriter& to) {
    to.put(std::uint32_t{0});
    put_shape(to, core::StepValues{});
  };
  CHECK(peer.error(RequestCode::MakePlan, put_plan) == "(no error)");
  peer.error(RequestCode::Step, [](PacketWriter& to) {
    to.put(StepRequest(0, {Time(), Time(Duration(5))}, false, false));
  });
  CHECK(set_error == "(no error)");
  CHECK_THAT(plan_error, Contains("in a step that none can make there"));
}

TEST_CASE("each request has words for errors of a link") {
  CHECK(std::string(words_of(code_of<&core::Unit::get>())) == "the reading of values");
  CHECK(std::string(words_of(RequestCode::Step)) == "a step");
}
