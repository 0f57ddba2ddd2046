// The temperatures that were sampled last.
#ifndef STRIDE_UNITS_SENSOR_SAMPLE_LOG_H
#define STRIDE_UNITS_SENSOR_SAMPLE_LOG_H

#include <array>
#include <cstddef>
#include <cstdint>

#include <stride/nfc/commands.h>
#include <stride/time.h>

namespace sensor {

struct Sample {
  stride::Time taken;
  std::int16_t centidegrees = 0;
};

/// A ring buffer: the newest sample takes the place of the oldest.
class SampleLog {
 public:
  void add(Sample sample) {
    samples_[(first_ + size_) % samples_.size()] = sample;
    if (size_ < samples_.size()) {
      ++size_;
    } else {
      first_ = (first_ + 1) % samples_.size();
    }
  }

  void clear() { size_ = 0; }
  std::size_t size() const { return size_; }
  /// The oldest has the index 0.
  const Sample& operator[](std::size_t index) const {
    return samples_[(first_ + index) % samples_.size()];
  }

 private:
  std::array<Sample, nfc::kLogSamples> samples_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace sensor

#endif
