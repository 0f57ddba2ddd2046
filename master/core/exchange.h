// The exchange of values at communication points: made once, then only copies.
#ifndef STRIDE_MASTER_CORE_EXCHANGE_H
#define STRIDE_MASTER_CORE_EXCHANGE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "master/core/observer.h"
#include "master/core/system.h"
#include "master/core/unit.h"

namespace stride::core {

/// For each unit and type one contiguous block of outputs and one of inputs, and a list of copies
/// between them. Clocked variables are not part of it: see messages.h. Nothing here allocates after
/// construction, except where a String or a Binary grows.
class Exchange {
 public:
  /// `recorded`: variables that are read although nobody is connected to them.
  Exchange(const System& system, std::span<const VariableId> recorded);

  /// Reads a unit's outputs and recorded variables.
  void fetch(std::size_t component, Unit& unit);
  /// Copies the outputs of all units to the inputs of all units.
  void route();
  /// Throws Error (Run) where a connected output is NaN.
  void check_nan(Time time) const;
  /// Whether a discrete input of the unit is not what was delivered last; FMI wants Event Mode
  /// then.
  bool has_discrete_change(std::size_t component) const {
    return has_discrete_inputs_[component] && any_discrete_change(component);
  }
  /// Writes a unit's continuous inputs, and the discrete ones if they changed.
  void deliver(std::size_t component, Unit& unit);

  /// Where the variable's value stands. An input that is connected is seen as its source left it.
  Signal signal(VariableId id) const;

  /// Likewise, of a variable that is connected, for who evaluates single variables: an output that
  /// was read belongs there, and deliver() takes an input from there. See evaluation.h.
  struct Place {
    ValueBlock* block = nullptr;
    std::size_t first = 0;
  };
  Place place(VariableId id);

 private:
  /// Variables of one type of one unit, read or written by one call.
  struct Transfer {
    ValueBlock block;
    bool discrete;         ///< written only where the values changed
    ValueBlock delivered;  ///< of a discrete one: what was written last
    bool is_new = true;    ///< nothing was written yet
    std::vector<ValueReference> references;
    std::vector<VariableId> ids;      ///< sorted
    std::vector<std::size_t> firsts;  ///< where each variable begins in the block
  };
  using Transfers = std::vector<std::vector<Transfer>>;  // by component; final once it is planned

  template <class T>
  struct Copy {
    T* to;
    const T* from;
  };
  template <class Real>
  struct ConvertedCopy {
    Real* to;
    const Real* from;
    double factor, offset;
  };
  template <class Real>
  struct Checked {
    const Real* value;
    VariableId id;
  };
  template <class Real>
  struct RealLists {
    std::vector<ConvertedCopy<Real>> converted;
    std::vector<Checked<Real>> checked;
  };

  bool any_discrete_change(std::size_t component) const;
  template <class Real>
  void check_nan(const RealLists<Real>& lists, Time time) const;
  void add_copies(const Connection& connection);
  template <class Real>
  void add_real(RealLists<Real>& lists, const Connection& connection, Real* to, const Real* from);
  /// The block that holds the variable and its place there; null if there is none.
  template <class SomeTransfers>
  static auto locate(SomeTransfers& transfers, VariableId id);

  const System& system_;
  Transfers outputs_;
  Transfers inputs_;
  std::vector<char> has_discrete_inputs_;                ///< by component
  std::array<std::vector<Copy<std::byte>>, 4> numbers_;  // of 1, 2, 4 and 8 bytes
  std::vector<Copy<std::string>> strings_;
  std::vector<Copy<Binary>> binaries_;
  RealLists<double> doubles_;
  RealLists<float> floats_;
};

}  // namespace stride::core

#endif
