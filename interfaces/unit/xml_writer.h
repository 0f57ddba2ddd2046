#ifndef STRIDE_INTERFACES_UNIT_XML_WRITER_H
#define STRIDE_INTERFACES_UNIT_XML_WRITER_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <stride/time.h>

namespace stride::kit {

/// Writes an indented XML document. The kit has its own, forty lines, because a unit's library
/// depends on nothing.
class XmlWriter {
 public:
  XmlWriter& open(std::string_view element);
  XmlWriter& attribute(std::string_view name, std::string_view value);
  XmlWriter& attribute(std::string_view name, const char* value) {
    return attribute(name, std::string_view(value));
  }
  XmlWriter& attribute(std::string_view name, bool value) {
    return attribute(name, std::string_view(value ? "true" : "false"));
  }
  XmlWriter& attribute(std::string_view name, double value);
  XmlWriter& attribute(std::string_view name, std::int64_t value);
  XmlWriter& close();

  /// The document; all elements must be closed.
  const std::string& text() const { return text_; }

 private:
  void end_tag_of_parent();

  std::string text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  std::vector<std::string> open_;
  bool tag_open_ = false;
};

/// The shortest text that reads back as the same number.
std::string to_text(double value);
std::string to_text(float value);
/// Of its seconds.
inline std::string to_text(Time time) { return to_text(to_seconds(time)); }

}  // namespace stride::kit

#endif
