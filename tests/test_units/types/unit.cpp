// Gives each input back at once: all value types of FMI 3.0, arrays, and messages on a clock.
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <stride/unit.h>

namespace {

enum class Colour : std::int64_t { Red = 1, Green = 2, Blue = 4 };

/// An input with its output of the same type. By the names of the variables: `<name>`,
/// `<name>.echo`.
template <class T>
struct Pair {
  T in{};
  T out{};
};

class Types : public stride::Unit {
 public:
  Types() {
    describe("Echoes every value type");
    add("float32", float32_);
    add("float64", float64_).unit("m");
    add("int8", int8_);
    add("uint8", uint8_);
    add("int16", int16_);
    add("uint16", uint16_);
    add("int32", int32_);
    add("uint32", uint32_);
    add("int64", int64_);
    add("uint64", uint64_);
    add("boolean", boolean_);
    add("string", string_);
    add("binary", binary_).mime_type("application/x-test");
    colour_.in = colour_.out = Colour::Red;
    input("colour", colour_.in).items(kColours);
    output("colour.echo", colour_.out).items(kColours).depends_on({"colour"});
    matrix_.in = {1, 2, 3, 4, 5, 6};
    input("matrix", matrix_.in).dimensions({2, 3});
    output("matrix.echo", matrix_.out).dimensions({2, 3}).depends_on({"matrix"});
    add("flags", flags_);
    add("words", words_);
    add("blobs", blobs_);
    input("receive.clock", receive_);
    input("receive.frame", frame_.in).clocked_by(receive_);
    output("send.clock", send_);
    output("send.frame", frame_.out).clocked_by(send_);
    parameter("gain", gain_).tunable().range(0, 10);
    output("gained", gained_).unit("m").depends_on({"float64"});
    state();
  }

  void initialize(stride::Time) override { echo(); }
  void step(stride::Step&) override { echo(); }
  void update_outputs() override { echo(); }
  std::string describe_message(const stride::Variable& variable,
                               const stride::Binary& value) const override {
    if (value.empty()) return "";
    if (value[0] == 0) throw std::runtime_error("nought");
    if (value[0] == 1) return "one,\ntwo";
    std::string text = std::to_string(value.size()) + " bytes in " + variable.name;
    if (value[0] != 2) return text;
    for (text.clear(); text.size() < 3000;) text += "é";
    return text;
  }
  void event(stride::Event&) override {
    if (!receive_.ticked()) return;
    frame_.out = frame_.in;
    send_.tick();
  }

 private:
  static inline const std::vector<std::pair<std::string, std::int64_t>> kColours = {
      {"red", 1}, {"green", 2}, {"blue", 4}};

  template <class T>
  stride::VariableBuilder add(const std::string& name, Pair<T>& pair) {
    input(name, pair.in);
    return output(name + ".echo", pair.out).depends_on({name});
  }

  template <class... T>
  static void copy(Pair<T>&... pairs) {
    ((pairs.out = pairs.in), ...);
  }

  void echo() {
    copy(float32_, float64_, int8_, uint8_, int16_, uint16_, int32_, uint32_, int64_, uint64_,
         boolean_, string_, binary_, colour_, matrix_, flags_, words_, blobs_);
    gained_ = gain_ * float64_.in;
  }

  Pair<float> float32_;
  Pair<double> float64_;
  Pair<std::int8_t> int8_;
  Pair<std::uint8_t> uint8_;
  Pair<std::int16_t> int16_;
  Pair<std::uint16_t> uint16_;
  Pair<std::int32_t> int32_;
  Pair<std::uint32_t> uint32_;
  Pair<std::int64_t> int64_;
  Pair<std::uint64_t> uint64_;
  Pair<bool> boolean_;
  Pair<std::string> string_;
  Pair<stride::Binary> binary_;
  Pair<Colour> colour_;
  Pair<std::array<double, 6>> matrix_;
  Pair<std::array<bool, 3>> flags_;
  Pair<std::array<std::string, 2>> words_;
  Pair<std::array<stride::Binary, 2>> blobs_;
  stride::Clock receive_;
  stride::Clock send_;
  Pair<stride::Binary> frame_;
  double gain_ = 1;
  double gained_ = 0;
};

}  // namespace

STRIDE_UNIT(Types)
