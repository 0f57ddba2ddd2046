#include "units/ground_truth/quantity.h"

#include "units/xml/document.h"

namespace ground_truth {
namespace {

constexpr const char* kRoot = "quantity";

Quantity quantity_of(const xml::Element& root) {
  root.allow_only_leaf({"version", "unit", "difference"});
  return {root.text("unit"), root.text("difference")};
}

}  // namespace

Quantity read_quantity(const std::string& file) {
  return quantity_of(xml::Document::load(file, kRoot, {"unit", "difference"}).root());
}

Quantity parse_quantity(const std::string& text, const std::string& file) {
  return quantity_of(xml::Document::parse(text, file, kRoot, {"unit", "difference"}).root());
}

}  // namespace ground_truth
