// How often the bins of a point were hit.
#ifndef STRIDE_MASTER_OBSERVE_COVERAGE_TALLY_H
#define STRIDE_MASTER_OBSERVE_COVERAGE_TALLY_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <stride/time.h>

#include "master/base/state_archive.h"
#include "master/observe/coverage/definition.h"

namespace stride::coverage {

/// Counts visits. Allocates only where a bin appears that was not declared.
class Tally {
 public:
  struct Bin {
    std::string name;
    bool is_ignored = false;
    std::uint64_t count = 0;
    Time first{};  ///< the first visit, if there was one
  };

  /// The definition must outlive it.
  explicit Tally(const PointDefinition& definition);

  /// The bin of this name, which is there from now on; kFurther where there would be too many.
  std::size_t find_or_add(std::string_view name);
  void visit(std::size_t bin, Time time) {
    Bin& visited = bins_[bin];
    if (visited.count++ == 0) visited.first = time;
  }

  /// The declared ones, and behind them the others as they appeared.
  const std::vector<Bin>& bins() const { return bins_; }
  std::size_t declared() const { return declared_; }

  void persist(core::StateArchive& state);

 private:
  void add(std::string name, bool is_ignored);

  const PointDefinition& definition_;
  std::size_t declared_;
  std::vector<Bin> bins_;
  std::vector<std::size_t> by_name_;
};

/// An index of one of `size` bins, or kNoBin.
void persist_bin(core::StateArchive& state, std::size_t& bin, std::size_t size);

}  // namespace stride::coverage

#endif
