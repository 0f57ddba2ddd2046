#ifndef STRIDE_MASTER_LOADER_WIRE_UNIT_TIMES_H
#define STRIDE_MASTER_LOADER_WIRE_UNIT_TIMES_H

#include <cstddef>
#include <optional>
#include <tuple>
#include <vector>

#include <stride/time.h>

#include "master/loader/wire/calls.h"

namespace stride::isolation {

/// The simulated time of a unit, and those of its saved states, for errors: both ends of the wire
/// follow the calls.
class UnitTimes {
 public:
  std::optional<Time> now{};

  /// The call is about to be made.
  template <auto function, class... Arguments>
  void note_begin(const Arguments&... arguments) {
    if constexpr (is_same_function<function, &core::Unit::enter_initialization>) {
      now = std::get<0>(std::tie(arguments...));
    } else if constexpr (is_same_function<function, &core::StateSaving::restore_state>) {
      if (slot_ < saved_.size()) now = saved_[slot_];
    }
  }
  /// The call was made, or is on its way.
  template <auto function, class... Arguments>
  void note_end(const Arguments&... arguments) {
    if constexpr (is_same_function<function, &core::StateSaving::select_state>) {
      slot_ = std::get<0>(std::tie(arguments...));
    } else if constexpr (is_same_function<function, &core::StateSaving::save_state>) {
      note_saved(now);
    } else if constexpr (is_same_function<function, &core::StateSerialization::deserialize_state>) {
      note_saved(std::nullopt);  // the bytes do not contain the time
    } else if constexpr (is_same_function<function, &core::Resetting::reset>) {
      now.reset();
    }
  }
  /// The state in the selected slot is of this time, or of one that is not known.
  void note_saved(std::optional<Time> time) {
    if (saved_.size() <= slot_) saved_.resize(slot_ + 1);
    saved_[slot_] = time;
  }

 private:
  std::size_t slot_ = 0;
  std::vector<std::optional<Time>> saved_;  ///< by slot
};

}  // namespace stride::isolation

#endif
