// A function that is called at the end of a block, however the block is left.
#ifndef STRIDE_UNITS_MUJOCO_WORLD_FILM_AT_END_H
#define STRIDE_UNITS_MUJOCO_WORLD_FILM_AT_END_H

#include <utility>

namespace mujoco_world::film {

/// Calls the function, which must not throw, when it is destroyed.
template <class Function>
class AtEnd {
 public:
  explicit AtEnd(Function function) : function_(std::move(function)) {}
  ~AtEnd() { function_(); }
  AtEnd(const AtEnd&) = delete;
  AtEnd& operator=(const AtEnd&) = delete;

 private:
  Function function_;
};

}  // namespace mujoco_world::film

#endif
