// The checked variable table of one unit: its rows in the order of their value references.
#ifndef STRIDE_INTERFACES_UNIT_TABLE_H
#define STRIDE_INTERFACES_UNIT_TABLE_H

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <stride/fmi3.h>
#include <stride/unit.h>

namespace stride::kit {

inline const char* name(Type type) { return type_name(type); }
const char* name(Causality causality);
const char* name(Variability variability);
const char* name(IntervalVariability variability);

/// Calls visitor(T* elements) with the C++ type that holds values of an FMI type.
template <class Visitor>
void visit(Type type, void* data, Visitor&& visitor) {
  switch (type) {
    case Type::Float32:
      return visitor(static_cast<float*>(data));
    case Type::Float64:
      return visitor(static_cast<double*>(data));
    case Type::Int8:
      return visitor(static_cast<std::int8_t*>(data));
    case Type::UInt8:
      return visitor(static_cast<std::uint8_t*>(data));
    case Type::Int16:
      return visitor(static_cast<std::int16_t*>(data));
    case Type::UInt16:
      return visitor(static_cast<std::uint16_t*>(data));
    case Type::Int32:
      return visitor(static_cast<std::int32_t*>(data));
    case Type::UInt32:
      return visitor(static_cast<std::uint32_t*>(data));
    case Type::Int64:
    case Type::Enumeration:
      return visitor(static_cast<std::int64_t*>(data));
    case Type::UInt64:
      return visitor(static_cast<std::uint64_t*>(data));
    case Type::Boolean:
      return visitor(static_cast<bool*>(data));
    case Type::String:
      return visitor(static_cast<std::string*>(data));
    case Type::Binary:
      return visitor(static_cast<Binary*>(data));
    case Type::Clock:
      return visitor(static_cast<Clock*>(data));
  }
}

inline bool is_time_based(const Variable& row) {
  return row.interval_variability != IntervalVariability::Triggered;
}
inline bool is_periodic(const Variable& row) {
  return row.interval_variability <= IntervalVariability::Tunable;
}

/// What the access functions need of a row, and no more, in one line of the cache.
struct alignas(32) Slot {
  Type type;              ///< of the functions that get and set it: Int64 for an Enumeration
  std::uint8_t settable;  ///< the modes in which it may be set
  bool is_discrete;
  std::size_t size;
  void* data;
};

/// The value reference of a variable is its place in the table; place 0 is the independent variable
/// `time`.
class Table {
 public:
  /// Checks the unit's rows: names unique and well-formed, dimensions, bounds that the type can
  /// hold, clocks and dependencies that exist, one verdict at most. Throws std::logic_error that
  /// names the variable and the mistake. `time` and `unit` must outlive the table.
  Table(const Unit& unit, double& time);

  std::size_t size() const { return rows_.size(); }
  const Variable& row(std::size_t reference) const { return *rows_[reference]; }
  const Slot& slot(std::size_t reference) const { return slots_[reference]; }
  /// Null if there is no such variable, or functions of this type do not get and set it.
  const Slot* find_slot(std::size_t reference, Type type) const {
    const bool is_found = reference < slots_.size() && slots_[reference].type == type;
    return is_found ? &slots_[reference] : nullptr;
  }

  const std::vector<Clock*>& input_clocks() const { return input_clocks_; }
  const std::vector<Clock*>& output_clocks() const { return output_clocks_; }

  /// The clock's value reference.
  fmi3ValueReference reference_of(const Clock& clock) const;
  /// Throws std::logic_error if there is no such variable.
  fmi3ValueReference reference_of(const std::string& name) const;

 private:
  void index_rows();
  void check(const Variable& row) const;
  void check_references(const Variable& row) const;
  void check_verdict() const;

  std::vector<Slot> slots_;
  std::vector<Clock*> output_clocks_;
  std::vector<Clock*> input_clocks_;
  Variable time_;
  std::vector<const Variable*> rows_;
  std::map<std::string_view, fmi3ValueReference> references_;  ///< by name
  std::map<const void*, fmi3ValueReference> clock_references_;
};

}  // namespace stride::kit

#endif
