#include "master/study/campaign/sampling.h"

#include <stdexcept>

#include <boost/random/sobol.hpp>
#include <fmt/format.h>

#include "master/study/campaign/random.h"

namespace stride::campaign {
namespace {

/// In the middle of the interval of numbers that begin with these 52 bits.
double in_unit_interval(std::uint64_t bits) {
  return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52;
}

}  // namespace

/// Boost's engine leaves out the first point, which is 0.
struct Sampling::SobolSequence {
  boost::random::sobol engine;
  std::vector<std::uint64_t> shifts;

  explicit SobolSequence(std::size_t dimensions) : engine(dimensions) {}

  std::vector<double> point(std::uint64_t index) const {
    std::vector<double> point;
    point.reserve(shifts.size());
    boost::random::sobol at = engine;
    if (index > 0) at.seed(index - 1);
    for (const std::uint64_t shift : shifts) {
      point.push_back(in_unit_interval((index > 0 ? at() : 0) ^ shift));
    }
    return point;
  }
};

std::size_t most_dimensions(SamplingMethod method) {
  return method == SamplingMethod::Sobol ? boost::random::default_sobol_table::max_dimension
                                         : SIZE_MAX;
}

Sampling::Sampling(SamplingMethod method, std::uint64_t seed, std::span<const std::string> names,
                   std::uint64_t count)
    : method_(method), count_(count) {
  if (names.size() > most_dimensions(method)) {
    throw std::invalid_argument(
        fmt::format("{} parameters are too many for {}, expected {} at most", names.size(),
                    name(method), most_dimensions(method)));
  }
  for (const std::string& name : names) streams_.emplace_back(seed, "parameter " + name);
  if (method != SamplingMethod::Sobol || names.empty()) return;
  auto sequence = std::make_unique<SobolSequence>(names.size());
  for (const std::string& name : names) {
    sequence->shifts.push_back(RandomStream(seed, "shift " + name).bits(0));
  }
  sobol_ = std::move(sequence);
}

Sampling::~Sampling() = default;
Sampling::Sampling(Sampling&&) noexcept = default;
Sampling& Sampling::operator=(Sampling&&) noexcept = default;

std::vector<double> Sampling::point(std::uint64_t index) const {
  if (sobol_) return sobol_->point(index);
  std::vector<double> point;
  point.reserve(streams_.size());
  for (const RandomStream& stream : streams_) {
    const double u = stream.uniform(index);
    if (method_ == SamplingMethod::LatinHypercube) {
      const auto interval = static_cast<double>(stream.permuted(index, count_));
      point.push_back((interval + u) / static_cast<double>(count_));
    } else {
      point.push_back(u);
    }
  }
  return point;
}

}  // namespace stride::campaign
