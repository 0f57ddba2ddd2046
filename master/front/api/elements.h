// Values in the C types of the library's interface.
#ifndef STRIDE_MASTER_FRONT_API_ELEMENTS_H
#define STRIDE_MASTER_FRONT_API_ELEMENTS_H

#include <cstddef>
#include <optional>
#include <vector>

#include <stride/master.h>

#include "master/engine/model/description.h"
#include "master/engine/model/values.h"

namespace stride::api {

inline stride_type type_of(core::ValueType type) { return static_cast<stride_type>(type); }
inline stride_causality causality_of(core::Causality causality) {
  return static_cast<stride_causality>(causality);
}

/// The elements of the variable. Throws core::Error (Input), with the context, where a String is
/// NULL or no UTF-8, bytes are NULL, or a Boolean is neither 0 nor 1.
core::ValueBlock read_elements(const core::Variable& variable, const core::Context& context,
                               const void* elements);

/// A value in its C types, which it keeps.
class CElements {
 public:
  CElements() = default;
  explicit CElements(core::ValueBlock value);

  const void* data() const;
  /// Copies the elements; pointers in them are to what is kept here.
  void copy_to(void* elements) const;

 private:
  std::optional<core::ValueBlock> value_;  ///< none: of a message without one
  std::vector<const char*> strings_;
  std::vector<stride_bytes> bytes_;
};

}  // namespace stride::api

#endif
