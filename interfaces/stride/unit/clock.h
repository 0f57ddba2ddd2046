#ifndef STRIDE_UNIT_CLOCK_H
#define STRIDE_UNIT_CLOCK_H

namespace stride {

/// A triggered clock of a unit (FMI 3.0, 2.2.8): the instant of a message, separate from its value.
///
/// As an output the unit calls tick() in step() or event(); the importer sees the tick in the Event
/// Mode that follows and the kit withdraws it when that super-dense instant is over. As an input it
/// has ticked during event() if the importer set it in this super-dense instant.
class Clock {
 public:
  void tick() { ticked_ = true; }
  bool ticked() const { return ticked_; }
  void clear() { ticked_ = false; }

 private:
  bool ticked_ = false;
};

}  // namespace stride

#endif
