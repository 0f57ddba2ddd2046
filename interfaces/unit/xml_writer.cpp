#include "interfaces/unit/xml_writer.h"

#include <cmath>

#include <stride/value_text.h>
#include <stride/xml_text.h>

namespace stride::kit {
namespace {

template <class Real>
std::string shortest(Real value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "INF" : "-INF";
  std::string text;
  append_value(text, value);
  return text;
}

}  // namespace

std::string to_text(double value) { return shortest(value); }
std::string to_text(float value) { return shortest(value); }

void XmlWriter::end_tag_of_parent() {
  if (tag_open_) text_ += ">\n";
  tag_open_ = false;
}

XmlWriter& XmlWriter::open(std::string_view element) {
  end_tag_of_parent();
  text_.append(2 * open_.size(), ' ').append("<").append(element);
  open_.emplace_back(element);
  tag_open_ = true;
  return *this;
}

XmlWriter& XmlWriter::attribute(std::string_view name, std::string_view value) {
  text_.append(" ").append(name).append("=\"").append(xml_escaped(value)).append("\"");
  return *this;
}

XmlWriter& XmlWriter::attribute(std::string_view name, double value) {
  return attribute(name, std::string_view(to_text(value)));
}

XmlWriter& XmlWriter::attribute(std::string_view name, std::int64_t value) {
  return attribute(name, std::string_view(std::to_string(value)));
}

XmlWriter& XmlWriter::close() {
  const std::string element = std::move(open_.back());
  open_.pop_back();
  if (tag_open_) {
    text_ += "/>\n";
  } else {
    text_.append(2 * open_.size(), ' ').append("</").append(element).append(">\n");
  }
  tag_open_ = false;
  return *this;
}

}  // namespace stride::kit
