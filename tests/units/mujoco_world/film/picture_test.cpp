#include "units/mujoco_world/film/picture.h"

#include <cstdlib>

#include <catch2/catch.hpp>

#include "tests/units/mujoco_world/film/jpeg.h"

using Catch::Matchers::Contains;
using mujoco_world::film::Picture;
using mujoco_world::film::to_jpeg;
using stride::tests::decoded;

namespace {

/// Left half red, right half blue; the uppermost quarter green.
Picture flag(int width, int height) {
  Picture picture{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool is_top = 4 * y < height;
      const bool is_left = 2 * x < width;
      for (const bool is_on : {!is_top && is_left, is_top, !is_top && !is_left}) {
        picture.rgb.push_back(is_on ? 255 : 0);
      }
    }
  }
  return picture;
}

}  // namespace

TEST_CASE("a picture that was a JPEG looks as before") {
  for (const auto& [width, height] : {std::pair(64, 48), std::pair(33, 17), std::pair(1, 1)}) {
    const Picture picture = flag(width, height);
    const Picture seen = decoded(to_jpeg(picture));
    REQUIRE(seen.width == width);
    REQUIRE(seen.height == height);
    double difference = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
      difference += std::abs(int{picture.rgb[i]} - int{seen.rgb[i]});
    }
    CHECK(difference / static_cast<double>(picture.rgb.size()) <
          20);  // colours are blurred at edges; another picture differs by 85
  }
}

TEST_CASE("the same picture gives the same bytes") {
  CHECK(to_jpeg(flag(64, 48)) == to_jpeg(flag(64, 48)));
}

TEST_CASE("a size that JPEG does not have is an error") {
  CHECK_THROWS_WITH(to_jpeg({70'000, 1, std::vector<std::uint8_t>(210'000)}),
                    Contains("cannot write a JPEG") && Contains("65500"));
  CHECK_THROWS_WITH(to_jpeg({0, 5, {}}), Contains("cannot write a JPEG"));
}
