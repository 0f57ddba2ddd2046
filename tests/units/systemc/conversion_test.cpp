// What SystemC's types are in FMI.
#include <cstdint>
#include <string>

#include <catch2/catch.hpp>

#include <stride/systemc/conversion.h>
#include <stride/systemc/module_unit.h>

#include "tests/units/systemc/rows.h"
#include "tests/units/systemc/times.h"

using Catch::Matchers::Contains;
using stride::Type;
using stride::systemc::Conversion;
using stride::systemc::inner;
using stride::tests::driver_of;
using stride::tests::Rows;
using stride::tests::UnitDriver;

namespace {

enum Phase : unsigned char { kOff = 3, kOn = 7 };

/// A value that only the tests know.
struct Complex {
  double re = 0, im = 0;
  bool operator==(const Complex& other) const { return re == other.re && im == other.im; }
};
std::ostream& operator<<(std::ostream& stream, const Complex& value) { return stream << value.re; }
void sc_trace(sc_core::sc_trace_file*, const Complex&, const std::string&) {}

/// Passes each input on.
template <class T>
struct Wire : sc_core::sc_module {
  sc_core::sc_in<T> in{"in"};
  sc_core::sc_out<T> out{"out"};
  explicit Wire(sc_core::sc_module_name name) : sc_module(name) {
    SC_HAS_PROCESS(Wire);
    SC_METHOD(pass);
    sensitive << in;
  }
  void pass() { out.write(in.read()); }
};

template <class T>
UnitDriver wire_of() {
  return driver_of<Wire<T>>([](Rows<Wire<T>>& rows) {
    rows.input("in", &Wire<T>::in);
    rows.output("out", &Wire<T>::out);
  });
}

}  // namespace

template <>
struct stride::systemc::Items<Phase> {
  static constexpr std::pair<const char*, Phase> kItems[] = {{"off", kOff}, {"on", kOn}};
};
template <>
struct stride::systemc::Conversion<Complex> {
  using Fmi = std::string;
  static Fmi to_fmi(const Complex& value) {
    return std::to_string(value.re) + ' ' + std::to_string(value.im);
  }
  static Complex from_fmi(const Fmi& text) {
    Complex value;
    if (!text.empty()) value = {std::stod(text), std::stod(text.substr(text.find(' ')))};
    return value;
  }
  static void describe(VariableBuilder&) {}
};

TEST_CASE("numbers of more than 64 bits are hexadecimal texts") {
  using Key = sc_dt::sc_biguint<128>;
  UnitDriver unit = wire_of<Key>();
  CHECK(unit.row("in").type == Type::String);
  unit.value<std::string>("in") = "0x2B7e151628aed2a6abf7158809cf4f3c";
  unit.initialize();
  CHECK(unit.value<std::string>("out") == "0x2b7e151628aed2a6abf7158809cf4f3c");
  unit.value<std::string>("in") = "ff";
  unit.step(stride::Time(stride::Duration(1000)));
  CHECK(unit.value<std::string>("out") == "0x000000000000000000000000000000ff");
  unit.value<std::string>("in") = "0x100000000000000000000000000000000";
  CHECK_THROWS_WITH(unit.step(stride::Time(stride::Duration(2000))),
                    Contains("in: 0x1000") && Contains("below 2^128"));

  CHECK(Conversion<sc_dt::sc_bv<65>>::to_fmi(sc_dt::sc_bv<65>(1)) == "0x00000000000000001");
  CHECK(Conversion<sc_dt::sc_bv<65>>::from_fmi("1ffffffffffffffff").and_reduce());
  CHECK(Conversion<sc_dt::sc_bigint<80>>::to_fmi(-1) == "0xffffffffffffffffffff");
  CHECK(Conversion<sc_dt::sc_bigint<80>>::from_fmi("0xffffffffffffffffffff") == -1);
  CHECK(Conversion<Key>::from_fmi("") == 0);
  CHECK_THROWS_WITH(Conversion<Key>::from_fmi("12g"), Contains("\"12g\"") && Contains("0x1f"));
}

TEST_CASE("numbers of a width that the model determines") {
  UnitDriver signed_wire = wire_of<sc_dt::sc_signed>();
  signed_wire.value<std::int64_t>("in") = -(std::int64_t{1} << 40);
  signed_wire.initialize();
  CHECK(signed_wire.value<std::int64_t>("out") == -(std::int64_t{1} << 40));
  UnitDriver unsigned_wire = wire_of<sc_dt::sc_unsigned>();
  unsigned_wire.value<std::uint64_t>("in") = ~std::uint64_t{0};
  unsigned_wire.initialize();
  CHECK(unsigned_wire.value<std::uint64_t>("out") == ~std::uint64_t{0});

  sc_dt::sc_unsigned wide(70);
  wide = 1;
  CHECK(Conversion<sc_dt::sc_unsigned>::to_fmi(wide) == 1);
  wide <<= 65;
  CHECK_THROWS_WITH(Conversion<sc_dt::sc_unsigned>::to_fmi(wide), Contains("64 bits"));
}

TEST_CASE("a bit is a Boolean") {
  UnitDriver unit = wire_of<sc_dt::sc_bit>();
  CHECK(unit.row("in").type == Type::Boolean);
  unit.value<bool>("in") = true;
  unit.initialize();
  CHECK(unit.value<bool>("out"));
}

TEST_CASE("an enum with items is an Enumeration, whatever its integer is") {
  UnitDriver unit = driver_of<Wire<Phase>>([](Rows<Wire<Phase>>& rows) {
    rows.input("in", &Wire<Phase>::in, Conversion<Phase>::to_fmi(kOff));
    rows.output("out", &Wire<Phase>::out);
  });
  CHECK(unit.row("out").type == Type::Enumeration);
  CHECK(unit.row("out").items.size() == 2);
  CHECK(unit.row("out").items[1] == std::pair<std::string, std::int64_t>("on", 7));
  unit.value<std::int64_t>("in") = 7;
  unit.initialize();
  CHECK(unit.value<std::int64_t>("out") == 7);
}

TEST_CASE("a struct travels as its Conversion says") {
  UnitDriver unit = wire_of<Complex>();
  unit.value<std::string>("in") = "1.5 -2";
  unit.initialize();
  CHECK(unit.value<std::string>("out") == "1.500000 -2.000000");
}
