#include "units/ground_truth/text.h"

#include <catch2/catch.hpp>

using ground_truth::quantity_text;

TEST_CASE("six digits and the unit") {
  CHECK(quantity_text(21.5053781, "degC") == "21.5054 degC");
  CHECK(quantity_text(-0.015, "K") == "-0.015 K");
  CHECK(quantity_text(0, "") == "0");
  CHECK(quantity_text(1.5e9, "Hz") == "1.5e+09 Hz");
}
