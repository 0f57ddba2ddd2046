#ifndef STRIDE_MASTER_ALGORITHM_ACTIVITIES_H
#define STRIDE_MASTER_ALGORITHM_ACTIVITIES_H

#include <vector>

#include "master/algorithm/observer.h"

namespace stride::core {

/// Reports activities to the observers that watch them. Without such an observer a report is one
/// comparison.
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
