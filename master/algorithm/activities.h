#ifndef STRIDE_MASTER_ALGORITHM_ACTIVITIES_H
#define STRIDE_MASTER_ALGORITHM_ACTIVITIES_H

#include <vector>

#include "master/algorithm/observer.h"

namespace stride::core {

/// Tells what components do to those who watch it. Where nobody does, that is one comparison.
class Activities {
 public:
  void add(Observer& observer) {
    if (observer.watches_activities()) watchers_.push_back(&observer);
  }
  void report(const Activity& activity) const {
    for (Observer* watcher : watchers_) watcher->on_activity(activity);
  }

 private:
  std::vector<Observer*> watchers_;
};

}  // namespace stride::core

#endif
