// How far components with steps of their own have come.
#ifndef STRIDE_MASTER_ENGINE_RUN_STEPPING_OWN_PROGRESS_H
#define STRIDE_MASTER_ENGINE_RUN_STEPPING_OWN_PROGRESS_H

#include <cstddef>

#include <stride/time.h>

namespace stride::core {

class OwnProgress {
 public:
  virtual ~OwnProgress() = default;
  /// Whether the component keeps a step of its own.
  virtual bool keeps(std::size_t component) const = 0;
  /// Up to where the component has stepped.
  virtual Time reached(std::size_t component) const = 0;
  bool is_behind(std::size_t component, Time now) const {
    return keeps(component) && reached(component) != now;
  }
};

}  // namespace stride::core

#endif
