// A module with ordinary ports as a unit, row by row.
#include <filesystem>
#include <memory>
#include <string>

#include <catch2/catch.hpp>
#include <unistd.h>

#include <stride/systemc/module_unit.h>

#include "tests/units/systemc/gadget.h"
#include "tests/units/systemc/gadget_unit.h"
#include "tests/units/systemc/rows.h"
#include "tests/units/systemc/times.h"
#include "tests/units/systemc/unit_driver.h"
#include "tests/units/systemc/vcd.h"

using Catch::Matchers::Contains;
using gadget::Gadget;
using gadget::GadgetUnit;
using stride::Binary;
using stride::Clock;
using stride::Duration;
using stride::Time;
using stride::Type;
using stride::systemc::counts_nothing;
using stride::systemc::inner;
using stride::systemc::Logic;
using stride::systemc::repeats_every;
using stride::systemc::Sender;
using stride::tests::driver_of;
using stride::tests::Rows;
using stride::tests::UnitDriver;

namespace {

using stride::tests::kMicrosecond;
using stride::tests::kNanosecond;
constexpr Duration kGadgetPeriod = 100 * kNanosecond;

using stride::tests::at;

struct GadgetDriver : UnitDriver {
  GadgetDriver() : UnitDriver(std::make_unique<GadgetUnit>()) {}
  void send(Binary data) {
    value<Binary>("rx.data") = std::move(data);
    value<Clock>("rx.clock").tick();
    event();
    value<Clock>("rx.clock").clear();
  }
};

/// Two inputs and an output, of a bool each.
struct Gate : sc_core::sc_module {
  sc_core::sc_in<bool> a{"a"}, b{"b"};
  sc_core::sc_out<bool> y{"y"};
  sc_core::sc_signal<int> changes{"changes"};
  explicit Gate(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Gate);
    SC_METHOD(on_change);
    sensitive << a << b;
  }
  void on_change() {
    y.write(a.read() && b.read());
    changes.write(changes.read() + 1);
  }
};

}  // namespace

TEST_CASE("the types of the rows follow from those of the ports") {
  GadgetDriver unit;
  const auto type = [&](const char* name) { return unit.row(name).type; };
  CHECK(type("step") == Type::UInt8);
  CHECK(unit.row("step").max == 15);
  CHECK(type("offset") == Type::Int16);
  CHECK(unit.row("offset").min == -2048);
  CHECK(type("level") == Type::Enumeration);
  CHECK(unit.row("level").items.size() == 4);
  CHECK(type("bus") == Type::String);
  CHECK(type("converter.temperature") == Type::Float64);
  CHECK(type("count") == Type::UInt32);
  CHECK_FALSE(unit.row("count").max.has_value());
  CHECK(type("wide") == Type::UInt64);
  CHECK(type("code") == Type::UInt16);
  CHECK(type("rx.data") == Type::Binary);
  CHECK(unit.row("rx.data").clock == &unit.value<Clock>("rx.clock"));
}

TEST_CASE("values reach the module, and come back from it") {
  GadgetDriver unit;
  unit.value<std::uint8_t>("step") = 3;
  unit.value<std::int16_t>("offset") = -2;
  unit.value<std::string>("bus") = "01ZX";
  unit.value<double>("converter.temperature") = 20.5;
  unit.initialize(at(kMicrosecond));  // the module's own time begins at 0 all the same
  CHECK(unit.value<Logic>("level_out") == Logic::Z);
  CHECK(unit.value<std::string>("bus_out") == "01ZX");
  CHECK(unit.value<std::uint16_t>("code") == 328);

  unit.step(at(2 * kMicrosecond));  // all edges up to 1 us are in the reset
  CHECK(unit.value<std::uint32_t>("count") == 0);
  unit.step(at(3 * kMicrosecond));
  CHECK(unit.value<std::uint32_t>("count") == 30);
  CHECK(unit.value<std::uint64_t>("wide") == std::uint64_t{2046} << 28);

  unit.value<double>("converter.temperature") = -0.5 + 30;
  unit.value<Logic>("level") = Logic::k1;
  unit.step(at(4 * kMicrosecond));
  CHECK(unit.value<std::uint16_t>("code") == 472);
  CHECK(unit.value<std::uint16_t>("converter.code") == 472);
  CHECK(unit.value<Logic>("level_out") == Logic::k1);
  CHECK(unit.value<double>("charge") == 3);
  CHECK(unit.value<double>("doubled") == 6);
}

TEST_CASE("a parameter reaches the constructor, and a unit can be initialized again") {
  GadgetDriver unit;
  unit.initialize();
  unit.step(at(2 * kMicrosecond));
  CHECK(unit.value<double>("current") == 0.5);
  const auto count = unit.value<std::uint32_t>("count");
  CHECK(count > 0);
  unit.value<int>("scale") = 4;
  unit.initialize();
  CHECK(unit.value<std::uint32_t>("count") == 0);
  unit.step(at(2 * kMicrosecond));
  CHECK(unit.value<double>("current") == 2);
  CHECK(unit.value<std::uint32_t>("count") == 4 * count);
}

TEST_CASE("a value that a port cannot hold is an error, and not cut off") {
  GadgetDriver unit;
  unit.initialize();
  unit.value<std::uint8_t>("step") = 16;
  CHECK_THROWS_WITH(unit.step(at(kMicrosecond)),
                    Contains("step: 16 does not fit") && Contains("0 to 15"));
  GadgetDriver other;
  other.value<std::string>("bus") = "012X";
  CHECK_THROWS_WITH(other.initialize(), Contains("bus: \"012X\"") && Contains("4 digits"));
}

TEST_CASE("messages go through FIFOs at their instant") {
  GadgetDriver unit;
  unit.initialize();
  unit.step(at(2 * kMicrosecond));
  unit.send({7, 8});
  CHECK_FALSE(unit.value<Clock>("tx.clock").ticked());

  CHECK(unit.step(at(3 * kMicrosecond), true) == at(2 * kMicrosecond + 100 * kNanosecond));
  CHECK(unit.value<Clock>("tx.clock").ticked());
  CHECK(unit.value<Binary>("tx.data") == Binary{7});
  unit.value<Clock>("tx.clock").clear();
  CHECK(unit.step(at(3 * kMicrosecond), true) == at(2 * kMicrosecond + 200 * kNanosecond));
  CHECK(unit.value<Binary>("tx.data") == Binary{8});
}

TEST_CASE("a value for a full FIFO is lost, with a warning") {
  GadgetDriver unit;
  unit.initialize();
  unit.send({1, 2, 3});
  CHECK(unit.log.empty());
  unit.send({4, 5, 6, 7});
  REQUIRE(unit.log.size() == 1);
  CHECK_THAT(unit.log[0].second, Contains("rx.data") && Contains("lost"));
}

TEST_CASE("messages go through functions, too") {
  struct Radio : sc_core::sc_module {
    Sender* send = nullptr;
    Binary heard;
    explicit Radio(sc_core::sc_module_name name) : sc_module(name) {}
  };
  std::optional<Sender> sender;
  UnitDriver unit = driver_of<Radio>([&](Rows<Radio>& rows) {
    rows.message_input("in.data", [](Radio& radio, const Binary& data) { radio.heard = data; });
    rows.message_output("out.data", [&sender](Radio&, Sender send) { sender = send; });
    rows.output("heard", [](const Radio& radio) { return static_cast<int>(radio.heard.size()); });
  });
  unit.initialize();
  unit.value<Binary>("in.data") = {1, 2, 3};
  unit.value<Clock>("in.clock").tick();
  unit.event();
  CHECK(unit.value<int>("heard") == 3);
  CHECK_FALSE(unit.value<Clock>("out.clock").ticked());
  REQUIRE(sender);
}

TEST_CASE("tied ports need no variable") {
  UnitDriver unit = driver_of<Gate>([](Rows<Gate>& rows) {
    rows.input("a", &Gate::a);
    rows.tie(&Gate::b, true);
    rows.tie(&Gate::y);
    rows.output("changes", inner<int>("changes"));
  });
  unit.value<bool>("a") = true;
  unit.initialize();
  CHECK(unit.value<int>("changes") == 1);  // inputs are there from the first delta cycle on
  unit.value<bool>("a") = false;
  unit.step(at(kNanosecond));
  CHECK(unit.value<int>("changes") == 2);
}

TEST_CASE("the frequency of a clock may be a parameter") {
  double frequency = 10e6;
  const auto list = [&](Rows<Gate>& rows) {
    rows.clock(&Gate::a, frequency);
    rows.tie(&Gate::b);
    rows.tie(&Gate::y);
    rows.output("changes", inner<int>("changes"));
  };
  UnitDriver unit = driver_of<Gate>(list);
  unit.initialize();
  unit.step(at(kMicrosecond - kNanosecond));
  const int fast = unit.value<int>("changes");
  frequency = 5e6;
  unit.initialize();
  UnitDriver slow = driver_of<Gate>(list);
  slow.initialize();
  slow.step(at(kMicrosecond - kNanosecond));
  CHECK(fast >= 20);
  CHECK(slow.value<int>("changes") == Approx(fast / 2).margin(1));
  frequency = 0;
  CHECK_THROWS_WITH(slow.initialize(), Contains("frequency") && Contains("more than 0"));
}

TEST_CASE("rows that do not fit the module are errors at initialization") {
  const auto error_of = [](auto list) -> std::string {
    UnitDriver unit = driver_of<Gate>(list);
    try {
      unit.initialize();
    } catch (const std::exception& error) {
      return error.what();
    }
    return "no error";
  };
  SECTION("a port without a row") {
    CHECK_THAT(error_of([](Rows<Gate>& rows) {
                 rows.input("a", &Gate::a);
                 rows.output("y", &Gate::y);
               }),
               Contains("device.b") && Contains("not bound") && Contains("input(), clock()"));
  }
  SECTION("a port with two rows") {
    CHECK_THAT(error_of([](Rows<Gate>& rows) {
                 rows.input("first", &Gate::a);
                 rows.input("second", &Gate::a);
                 rows.tie(&Gate::b);
                 rows.tie(&Gate::y);
               }),
               Contains("device.a") && Contains("first and second"));
  }
  SECTION("a name that the module does not have") {
    CHECK_THAT(
        error_of([](Rows<Gate>& rows) { rows.output("x", inner<int>("change")); }),
        Contains("x: ") && Contains("no port or signal change") && Contains("a, b, y, changes"));
  }
  SECTION("a name of another type") {
    CHECK_THAT(error_of([](Rows<Gate>& rows) { rows.output("x", inner<double>("changes")); }),
               Contains("x: device.changes is a sc_signal") && Contains("double"));
  }
  SECTION("a clock for an output") {
    CHECK_THAT(error_of([](Rows<Gate>& rows) { rows.clock(&Gate::y, kGadgetPeriod); }),
               Contains("device.y") && Contains("sc_in<bool>"));
  }
  SECTION("a message without a dot in its name") {
    CHECK_THROWS_WITH(
        driver_of<Gadget>([](Rows<Gadget>& rows) { rows.message_input("rx", &Gadget::rx); }),
        Contains("rx.data") && Contains("rx.clock"));
  }
}

TEST_CASE("an input for a port that is bound within the module is an error") {
  struct Board : sc_core::sc_module {
    Gate gate{"gate"};
    sc_core::sc_signal<bool> a{"a"}, b{"b"}, y{"y"};
    explicit Board(sc_core::sc_module_name name) : sc_module(name) {
      gate.a(a);
      gate.b(b);
      gate.y(y);
    }
  };
  UnitDriver wrong = driver_of<Board>([](Rows<Board>& r) { r.input("a", inner<bool>("gate.a")); });
  CHECK_THROWS_WITH(wrong.initialize(), Contains("device.gate.a"));

  UnitDriver right = driver_of<Board>([](Rows<Board>& rows) {
    rows.input("a", &Board::a);
    rows.input("b", &Board::b, true);
    rows.output("y", inner<bool>("gate.y"));
  });
  right.value<bool>("a") = true;
  right.initialize();
  CHECK(right.value<bool>("y"));
}

TEST_CASE("a module that needs more than its name") {
  struct Picky : sc_core::sc_module {
    sc_core::sc_time delay;
    Picky(sc_core::sc_module_name name, sc_core::sc_time delay_) : sc_module(name), delay(delay_) {}
  };
  const auto list = [](Rows<Picky>& rows) {
    rows.output("delay", [](const Picky& picky) { return picky.delay; });
  };
  UnitDriver without = driver_of<Picky>(list);
  CHECK_THROWS_WITH(without.initialize(), Contains("construct()"));
  UnitDriver with = driver_of<Picky>([&](Rows<Picky>& rows) {
    list(rows);
    rows.construct_by([](const char* name) {
      return std::make_unique<Picky>(name, sc_core::sc_time(5, sc_core::SC_NS));
    });
  });
  with.initialize();
  CHECK(with.value<double>("delay") == 5e-9);
}

TEST_CASE("skipping the idle time of a module with a clock changes no value") {
  const auto make = [] {
    return driver_of<Gadget>([](Rows<Gadget>& rows) {
      rows.clock(&Gadget::clk, kGadgetPeriod);
      rows.tie(&Gadget::rst_n, true);
      rows.input("step", &Gadget::step);
      rows.tie(&Gadget::offset);
      rows.tie(&Gadget::level);
      rows.tie(&Gadget::bus);
      rows.input("t", inner<double>("converter.temperature"));
      rows.output("count", &Gadget::count);
      rows.output("code", inner<sc_dt::sc_uint<12>>("code"));
      rows.tie(&Gadget::wide);
      rows.tie(&Gadget::level_out);
      rows.tie(&Gadget::bus_out);
      rows.message_input("rx.data", &Gadget::rx);
      rows.message_output("tx.data", &Gadget::tx);
      rows.idle_when([](const Gadget& g) { return g.step.read() == 0; },
                     repeats_every(2 * kGadgetPeriod));  // the converter has odd and even cycles
    });
  };
  UnitDriver full = make();
  UnitDriver skipping = make();
  skipping.enable_skipping();
  for (UnitDriver* unit : {&full, &skipping}) {
    unit->initialize();
    for (int i = 1; i <= 20; ++i) {
      unit->value<std::uint8_t>("step") = i % 5 == 0 ? 2 : 0;
      unit->value<double>("t") = 10 + i;
      unit->step(at(i * (30 * kMicrosecond + Duration(7777))));
    }
    unit->unit().terminate();
  }
  CHECK(full.value<std::uint32_t>("count") > 1000);
  CHECK(skipping.value<std::uint32_t>("count") == full.value<std::uint32_t>("count"));
  CHECK(skipping.value<std::uint16_t>("code") == full.value<std::uint16_t>("code"));
  REQUIRE(skipping.log.size() == 1);
  CHECK_THAT(skipping.log[0].second, Contains("16 skips"));
}

TEST_CASE("a module that is idle need not be called, if its outputs are ports and signals") {
  const auto make = [](bool with_function) {
    return driver_of<Gate>([with_function](Rows<Gate>& rows) {
      rows.input("a", &Gate::a);
      rows.tie(&Gate::b, true);
      rows.output("y", &Gate::y);
      rows.idle_when([](const Gate& gate) { return !gate.a.read(); }, counts_nothing());
      if (with_function) rows.output("changed", [](const Gate& g) { return g.changes.read() > 1; });
    });
  };
  UnitDriver unit = make(false);
  unit.enable_skipping();
  unit.initialize();
  unit.step(at(kMicrosecond));
  CHECK(unit.idle_until() == Time::max());
  unit.value<bool>("a") = true;
  CHECK(unit.idle_until() == unit.now());

  UnitDriver computing = make(true);
  computing.enable_skipping();
  computing.initialize();
  computing.step(at(kMicrosecond));
  CHECK(computing.idle_until() == computing.now());
}

TEST_CASE("ports and inner signals can be traced under their names") {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("stride_gadget_" + std::to_string(getpid())))
          .string() +
      ".vcd";
  {
    GadgetDriver unit;
    unit.value<std::string>("trace.file") = file;
    unit.value<std::string>("trace.signals") = "count rst_n clk code converter.temperature wide";
    unit.initialize();
    unit.step(at(2 * kMicrosecond));
  }
  const stride::tests::Vcd vcd = stride::tests::read_vcd(file);
  std::filesystem::remove(file);
  CHECK(vcd.of("gadget.count").size() == 11);
  CHECK(vcd.of("gadget.rst_n").back() == std::pair<std::int64_t, std::string>(1'050'000, "1"));
  CHECK(vcd.of("gadget.clk").size() > 30);
  CHECK(vcd.of("gadget.code").size() == 1);
  CHECK(vcd.signals.size() == 7);
}
