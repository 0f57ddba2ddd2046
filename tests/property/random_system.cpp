#include "tests/property/random_system.h"

#include <cstdint>

#include <fmt/format.h>

#include "tests/test_units/counted_random.h"

namespace stride::tests {
namespace {

class Maker {
 public:
  Maker(unsigned seed, Wiring wiring) : seed_(seed), wiring_(wiring) {}

  Assembly make() {
    const std::size_t size = 2 + below(11);
    for (std::size_t i = 0; i < size; ++i) add_unit(fmt::format("u{}", i));
    for (const std::string& input : inputs_) {
      if (!sources_.empty() && below(5) > 0) assembly_.wire(one_of(sources_), input);
    }
    for (const std::string& listener : listeners_) {
      if (!senders_.empty()) assembly_.wire_message(one_of(senders_), listener + ".message");
    }
    return std::move(assembly_);
  }

 private:
  std::uint64_t below(std::uint64_t limit) { return random_bits(seed_, count_++) % limit; }
  std::string between(double low, double high) {
    return fmt::format("{}", low + (high - low) * random_uniform(seed_, count_++));
  }
  const std::string& one_of(const std::vector<std::string>& names) {
    return names[below(names.size())];
  }
  /// The variant that cannot save its state, once.
  std::string variant(const std::string& unit) {
    if (has_stateless_ || below(4) > 0) return unit;
    has_stateless_ = true;
    return unit + "_without_state";
  }

  void add_unit(const std::string& name) {
    switch (below(6)) {
      case 0:
        assembly_.add(name, "linear",
                      {{"damping", between(0, 5)}, {"frequency", between(-100, 100)}});
        return add_connectors(name, {".x", ".y"});
      case 1:
        assembly_.add(name, variant("rejecter"),
                      {{"seed", fmt::format("{}", below(1000))},
                       {"shortest", between(5e-5, 2e-4)},
                       {"longest", between(1e-3, 3e-3)}});
        return add_connectors(name, {".y"});
      case 2:
        assembly_.add(name, variant("early"),
                      {{"instants", instants()}, {"wants_events", below(2) == 0 ? "1" : "0"}});
        return add_connectors(name, {".y"});
      case 3:
        assembly_.add(name, "ticker",
                      {{"period", between(1e-3, 5e-3)}, {"announces", below(2) == 0 ? "1" : "0"}});
        sources_.push_back(name + ".level");
        senders_.push_back(name + ".tick");
        return;
      case 4:
        assembly_.add(name, "bouncing_ball",
                      {{"start_height", between(1e-4, 2e-3)}, {"restitution", between(0.5, 0.9)}});
        if (wiring_ == Wiring::Continuous) sources_.push_back(name + ".h");
        senders_.push_back(name + ".impact");
        return;
      default:
        assembly_.add(name, "listener");
        listeners_.push_back(name);
    }
  }

  void add_connectors(const std::string& name, const std::vector<std::string>& outputs) {
    inputs_.push_back(name + ".u");
    if (wiring_ == Wiring::EventsOnly) return;
    for (const std::string& output : outputs) sources_.push_back(name + output);
  }

  std::string instants() {
    std::string text;
    for (int i = 0; i < 8; ++i) text += between(0, 0.1) + " ";
    return text;
  }

  unsigned seed_;
  Wiring wiring_;
  std::uint64_t count_ = 0;
  bool has_stateless_ = false;
  Assembly assembly_;
  std::vector<std::string> inputs_, sources_, senders_, listeners_;
};

}  // namespace

Assembly random_system(unsigned seed, Wiring wiring) { return Maker(seed, wiring).make(); }

Assembly with_rejecters(unsigned seed, Wiring wiring, const std::string& shortest,
                        const std::string& longest) {
  Assembly system = random_system(seed, wiring);
  system.add("source", "linear");
  for (const std::string name : {"r1", "r2"}) {
    system.add(name, "rejecter", {{"shortest", shortest}, {"longest", longest}});
    system.wire("source.x", name + ".u");
  }
  return system.set("r2.seed", "2");
}

}  // namespace stride::tests
