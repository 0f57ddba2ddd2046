#include "master/engine/model/conversion.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "master/base/text/boolean_text.h"
#include "master/base/text/suggest.h"
#include "master/engine/model/item_match.h"
#include "master/engine/model/item_text.h"
#include "master/engine/model/meant_value.h"
#include "master/engine/model/number_range.h"

namespace stride::core {
namespace {

/// b after a
LinearConversion then(const LinearConversion& a, const LinearConversion& b) {
  if (a.is_identity()) return b;
  return {b.factor * a.factor, b.factor * a.offset + b.offset};
}

NumberMap then(const NumberMap& a, const NumberMap& b) {
  std::map<std::int64_t, std::int64_t> all(b.begin(), b.end());
  for (const auto& [source, target] : a) all[source] = mapped(b, target);
  return {all.begin(), all.end()};
}

/// What false and true become, by way of numbers, as false or true.
NumberMap truth_of(const NumberMap& map) {
  return {{0, mapped(map, 0) != 0}, {1, mapped(map, 1) != 0}};
}

std::optional<std::int64_t> number_of(const EnumerationItems& items, const std::string& name) {
  for (const auto& [item, number] : items) {
    if (item == name) return number;
  }
  return std::nullopt;
}

bool has_unit(const PathConnector& connector) { return !connector.unit.name.empty(); }

bool is_relative(const PathConnector& connector) { return connector.is_relative.value_or(false); }

/// Composes the segments of a path, one after the other.
class Composer {
 public:
  Composer(const std::vector<PathConnector>& path, std::span<const PathSegment> segments,
           const Context& context)
      : path_(completed(path)),
        segments_(segments),
        context_(context),
        is_text_(!path.front().type),
        is_difference_(std::ranges::any_of(path, &is_relative)) {}

  LinearConversion linear() const {
    LinearConversion linear;
    bool is_plain = true;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      check_types(i);
      check_transformation(i);
      const Transformation& transformation = segments_[i].transformation;
      linear = then(linear, unit_conversion(i));
      if (transformation.kind == Transformation::Kind::Linear) {
        linear = then(linear, transformation.linear);
      }
      is_plain &= !segments_[i].suppress_unit_conversion &&
                  transformation.kind != Transformation::Kind::Linear;
    }
    if (!is_real(type(segments_.size()))) return {};
    // by way of another unit, it would be rounded more than once
    const auto direct = unit_conversion(first_unit(path_), path_.back().unit);
    return is_plain && direct ? *direct : linear;
  }

  Conversion conversion() const {
    Conversion conversion{linear(), {}, {}, {}};
    NumberMap* map = &conversion.map;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const bool becomes_boolean = is_integer(type(i)) && type(i + 1) == ValueType::Boolean;
      const bool is_mapped_behind = becomes_boolean && is_boolean(i);
      if (!is_mapped_behind) *map = then(*map, numbers(i));
      if (becomes_boolean && type(0) == ValueType::Boolean) *map = truth_of(*map);
      if (becomes_boolean && type(0) != ValueType::Boolean) map = &conversion.truth;
      if (is_mapped_behind) *map = then(*map, numbers(i));
    }
    check_results(conversion);
    std::erase_if(conversion.map, [&](const auto& entry) {
      const auto range = range_of(type(0));
      return range && !range->holds(entry.first);
    });
    return conversion;
  }

  /// Of an Enumeration, by the names of the items.
  std::string words(std::string text, bool is_integer) const {
    if (is_integer && !is_mapping(0)) text = names(text, path_.front().items);
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (!is_mapping(i) && unmapped_items(i).empty() && !changes_items(i)) continue;
      std::string result;
      for (const std::string& element : elements(i, text)) {
        const bool is_number = is_integer && i == 0;
        result += (result.empty() ? "" : " ") + word(i, element, is_number);
      }
      text = result;
    }
    return text;
  }

 private:
  ValueType type(std::size_t place) const { return *path_[place].type; }

  bool is_mapping(std::size_t segment) const {
    const Transformation::Kind kind = segments_[segment].transformation.kind;
    return kind != Transformation::Kind::None && kind != Transformation::Kind::Linear;
  }

  bool are_enumerations(std::size_t segment) const {
    return type(segment) == ValueType::Enumeration && type(segment + 1) == ValueType::Enumeration;
  }

  /// Whether an Enumeration becomes another one or an integer, or the other way round.
  bool changes_items(std::size_t segment) const {
    const PathConnector& from = path_[segment];
    const PathConnector& to = path_[segment + 1];
    if (from.type == to.type) return are_enumerations(segment) && from.items != to.items;
    return from.type == ValueType::Enumeration || to.type == ValueType::Enumeration;
  }

  std::string names(const std::string& numbers, const EnumerationItems& items) const {
    if (items.empty()) return numbers;
    try {
      return numbers_as_names(meant_value(ValueType::Int64, numbers).value_or(numbers), items);
    } catch (const std::invalid_argument& mistake) {
      fail(mistake.what(), "");
    }
  }

  /// Those of the text before a segment.
  std::vector<std::string> elements(std::size_t segment, const std::string& text) const {
    try {
      return item_words(text, known_items(segment));
    } catch (const std::invalid_argument& mistake) {
      fail(mistake.what(), "");
    }
  }

  EnumerationItems known_items(std::size_t segment) const {
    EnumerationItems items = path_[segment].items;
    for (const auto& [source, target] : segments_[segment].transformation.names) {
      if (!number_of(items, source)) items.emplace_back(source, 0);
    }
    return items;
  }

  /// Whether the segment's mapping is one of Boolean.
  bool is_boolean(std::size_t segment) const {
    return segments_[segment].transformation.kind == Transformation::Kind::BooleanMapping;
  }

  std::string wire(std::size_t segment) const {
    return fmt::format("'{}' to '{}'", path_[segment].name, path_[segment + 1].name);
  }

  [[noreturn]] void fail(const std::string& message, const std::string& hint) const {
    fail_input(context_, message, hint);
  }
  [[noreturn]] void fail(const Transformation& at, const std::string& message,
                         const std::string& hint) const {
    fail_input({at.where, {}, {}, {}}, message, hint);
  }

  void check_types(std::size_t segment) const {
    const PathConnector& from = path_[segment];
    const PathConnector& to = path_[segment + 1];
    // what an enumeration's items become behind a mapping is checked at the end
    const bool is_checked_later =
        is_integer(*from.type) && is_integer(*to.type) &&
        segments_[segment].transformation.kind != Transformation::Kind::None;
    if (is_checked_later || converts_without_loss(*from.type, *to.type, from.items)) return;
    if (is_real(*from.type) && is_real(*to.type)) return;
    if (is_boolean_conversion(segment)) return;
    fail(fmt::format("cannot connect {}: {} and {} are different types, and {}", wire(segment),
                     core::name(*from.type), core::name(*to.type),
                     range_of(*from.type) && range_of(*to.type)
                         ? fmt::format("not every {} is {}", core::name(*from.type),
                                       name_with_article(*to.type))
                         : "one is not converted into the other"),
         hint_for(*from.type, *to.type));
  }

  static const char* hint_for(ValueType from, ValueType to) {
    if (is_integer(from) && is_integer(to)) {
      return "an <ssc:IntegerMappingTransformation> whose targets all fit defines which become "
             "which; otherwise put a unit between them that converts the value";
    }
    if (is_real(from) && is_integer(to)) {
      return "SSP does not define how a number with a fraction becomes an integer, and has no "
             "transformation for it: put a unit between them that rounds the value";
    }
    return "put a unit between them that converts the value, or use one with another type";
  }

  /// What is behind a number that became a Boolean must be one, too: the number goes to the end.
  bool is_boolean_conversion(std::size_t segment) const {
    const auto is_boolean = [](const PathConnector& c) { return c.type == ValueType::Boolean; };
    if (boolean_conversion(type(segment), type(segment + 1)).empty()) return false;
    return is_boolean(path_[segment]) ||
           std::all_of(path_.begin() + static_cast<std::ptrdiff_t>(segment) + 1, path_.end(),
                       is_boolean);
  }

  /// Which types a transformation is for: SSP 2.0, "Transformation Choice".
  void check_transformation(std::size_t segment) const {
    const Transformation& transformation = segments_[segment].transformation;
    const ValueType from = type(segment), to = type(segment + 1);
    const bool is_of_text = segment == 0 && is_text_;
    if (is_of_text ? is_for_text(transformation.kind, to) : is_for(transformation.kind, from, to)) {
      return;
    }
    fail(transformation,
         fmt::format("{} is for {}, and {} is a connection from {} to {}",
                     name_with_article(transformation.kind), types_of(transformation.kind),
                     wire(segment), core::name(from), core::name(to)),
         fmt::format("transform such values by {}", transformation_for(from, to)));
  }

  /// What keeps the unit of a connector from being converted.
  std::string undefined(const PathConnector& connector) const {
    if (meaning_of(connector.unit)) return "";
    return fmt::format(
        "; no <BaseUnit> says what '{}' is, neither in {} nor where '{}' is declared, and it is "
        "not known by name",
        connector.unit.name, context_.where.file.empty() ? "the system" : context_.where.file,
        connector.name);
  }

  std::optional<LinearConversion> unit_conversion(const UnitOfMeasure& from,
                                                  const UnitOfMeasure& to) const {
    auto conversion = convert(from, to);
    if (conversion && is_difference_) conversion->offset = 0;
    return conversion;
  }

  LinearConversion unit_conversion(std::size_t segment) const {
    if (segments_[segment].suppress_unit_conversion) return {};
    const PathConnector& from = path_[segment];
    const PathConnector& to = path_[segment + 1];
    if (const auto conversion = unit_conversion(from.unit, to.unit)) return *conversion;
    fail(fmt::format("cannot connect {}: '{}' is in '{}', '{}' in '{}', and one cannot be "
                     "converted into the other{}{}",
                     wire(segment), from.name, from.unit.name, to.name, to.unit.name,
                     undefined(from), undefined(to)),
         "correct the wiring or the <Units>, or set suppressUnitConversion=\"true\" if the numbers "
         "fit");
  }

  std::int64_t item(const Transformation& transformation, std::size_t place,
                    const std::string& name) const {
    const PathConnector& connector = path_[place];
    if (const auto number = number_of(connector.items, name)) return *number;
    std::vector<std::string> known;
    for (const auto& [item, number] : connector.items) known.push_back(item);
    fail(transformation,
         fmt::format("the Enumeration of '{}' has no item '{}'", connector.name, name),
         known.empty() ? "its connector declares no enumeration" : suggestion(name, known));
  }

  /// What nothing maps goes by the names of the items, where these tell it.
  NumberMap unmapped_items(std::size_t segment) const {
    const Transformation::Kind kind = segments_[segment].transformation.kind;
    const PathConnector& from = path_[segment];
    const PathConnector& to = path_[segment + 1];
    if (!are_enumerations(segment) || kind == Transformation::Kind::IntegerMapping) return {};
    EnumerationItems items = from.items;
    for (const auto& [source, target] : segments_[segment].transformation.names) {
      std::erase_if(items, [&](const auto& item) { return item.first == source; });
    }
    const ItemMatch match = match_items(items, to.items);
    if (match.contradictions.empty()) return match.by_name;
    fail(fmt::format("cannot connect {}: items of the same names have different numbers, and not "
                     "all items are in both: {}",
                     wire(segment), fmt::join(match.contradictions, ", ")),
         "define what each item becomes, in an <ssc:EnumerationMappingTransformation>");
  }

  /// A segment's mapping as one of numbers.
  NumberMap numbers(std::size_t segment) const {
    const Transformation& transformation = segments_[segment].transformation;
    NumberMap map = transformation.numbers;
    for (const auto& entry : unmapped_items(segment)) map.push_back(entry);
    for (const auto& [source, target] : transformation.names) {
      map.emplace_back(item(transformation, segment, source),
                       item(transformation, segment + 1, target));
    }
    std::sort(map.begin(), map.end());
    const PathConnector& to = path_[segment + 1];
    const auto range = range_of(*to.type);
    for (const auto& [source, target] : map) {
      if (range && !range->holds(target)) {
        fail(transformation,
             fmt::format("the target {} of the mapping is not a valid {}, which '{}' is", target,
                         core::name(*to.type), to.name),
             "choose a number that it can have");
      }
      if (*to.type == ValueType::Enumeration) check_item(transformation, to, target);
    }
    return map;
  }

  void check_item(const Transformation& transformation, const PathConnector& to,
                  std::int64_t target) const {
    const bool is_known =
        to.items.empty() || std::any_of(to.items.begin(), to.items.end(),
                                        [&](const auto& item) { return item.second == target; });
    if (is_known) return;
    fail(transformation,
         fmt::format("the target {} of the mapping is not an item of the Enumeration of '{}'",
                     target, to.name),
         fmt::format("its items are {}", item_text(to.items)));
  }

  /// Whatever an enumeration's items, or the numbers of an integer, become must be in the target.
  void check_results(Conversion& conversion) const {
    const PathConnector& first = path_.front();
    const PathConnector& last = path_.back();
    if (*first.type == ValueType::Boolean && is_integer(*last.type)) {
      check_result("value 'false'", mapped(conversion.map, 0));
      check_result("value 'true'", mapped(conversion.map, 1));
    }
    if (!is_integer(*first.type) || !is_integer(*last.type)) return;
    const bool to_items = *last.type == ValueType::Enumeration && !last.items.empty();
    if (*first.type == ValueType::Enumeration && !first.items.empty()) {
      for (const auto& [item, number] : first.items) {
        check_result(fmt::format("item '{}'", item), mapped(conversion.map, number));
      }
      return;
    }
    if (to_items) {
      for (const auto& [item, number] : last.items) conversion.valid.push_back(number);
      std::sort(conversion.valid.begin(), conversion.valid.end());
      return;
    }
    if (converts_without_loss(*first.type, *last.type, first.items)) return;
    fail(fmt::format("cannot connect '{}' to '{}': not every {} is {}, and what the mapping does "
                     "not name stays what it is",
                     first.name, last.name, core::name(*first.type), name_with_article(*last.type)),
         "put a unit between them that converts the value, or use one with another type");
  }

  void check_result(const std::string& value, std::int64_t becomes) const {
    const PathConnector& first = path_.front();
    const PathConnector& last = path_.back();
    const bool to_items = *last.type == ValueType::Enumeration && !last.items.empty();
    const bool is_known = to_items ? std::any_of(last.items.begin(), last.items.end(),
                                                 [&](const auto& i) { return i.second == becomes; })
                                   : range_of(*last.type)->holds(becomes);
    if (is_known) return;
    fail(fmt::format("cannot connect '{}' to '{}': the {} of the one becomes {}, which is "
                     "not {}",
                     first.name, last.name, value, becomes,
                     to_items ? fmt::format("an item of the other: {}", item_text(last.items))
                              : fmt::format("a valid {}", core::name(*last.type))),
         to_items ? "define what it becomes, in an <ssc:EnumerationMappingTransformation>"
                  : "define what it becomes, in an <ssc:IntegerMappingTransformation>");
  }

  /// `is_number`: and not a name.
  std::string word(std::size_t segment, const std::string& word, bool is_number) const {
    switch (segments_[segment].transformation.kind) {
      case Transformation::Kind::EnumerationMapping:
        return mapped_item(segment, word);
      case Transformation::Kind::BooleanMapping:
        return mapped_boolean(segment, word);
      case Transformation::Kind::IntegerMapping:
        return mapped_number(segment, word, is_number);
      default:
        return unmapped_item(segment, word);
    }
  }

  std::string unmapped_item(std::size_t segment, const std::string& word) const {
    const auto number = type(segment) == ValueType::Enumeration
                            ? item_number(word, path_[segment].items)
                            : whole_number(word);
    return number ? item_word(segment + 1, mapped(unmapped_items(segment), *number)) : word;
  }

  std::string mapped_item(std::size_t segment, const std::string& word) const {
    const auto number = item_number(word, path_[segment].items);
    const std::string name = number ? item_word(segment, *number) : word;
    for (const auto& [source, target] : segments_[segment].transformation.names) {
      if (source == word || source == name) return target;
    }
    return unmapped_item(segment, word);
  }

  std::string mapped_boolean(std::size_t segment, const std::string& word) const {
    const auto source = boolean_of(meant_value(ValueType::Boolean, word).value_or(word));
    if (!source) return word;
    const NumberMap& map = segments_[segment].transformation.numbers;
    return mapped(map, *source ? 1 : 0) != 0 ? "true" : "false";
  }

  std::string mapped_number(std::size_t segment, const std::string& word, bool is_number) const {
    const auto named = number_of(path_[segment].items, word);
    const auto number = named && !is_number ? named : whole_number(word);
    if (!number) return word;
    return item_word(segment + 1, mapped(segments_[segment].transformation.numbers, *number));
  }

  static std::optional<std::int64_t> whole_number(const std::string& word) {
    const std::string plain = meant_value(ValueType::Int64, word).value_or(word);
    const char* const last = plain.data() + plain.size();
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(plain.data(), last, number);
    return end == last && error == std::errc{} ? std::optional(number) : std::nullopt;
  }

  /// The name of the connector's item, if it has one of this number; else the number.
  std::string item_word(std::size_t place, std::int64_t number) const {
    return item_name(number, path_[place].items);
  }

  std::vector<PathConnector> path_;
  std::span<const PathSegment> segments_;
  const Context& context_;
  bool is_text_;  ///< which becomes a value of the type of the second connector
  bool is_difference_;
};

}  // namespace

std::int64_t mapped(const NumberMap& map, std::int64_t value) {
  const auto found = std::lower_bound(map.begin(), map.end(), value,
                                      [](const auto& entry, auto v) { return entry.first < v; });
  return found != map.end() && found->first == value ? found->second : value;
}

bool converts_without_loss(ValueType from, ValueType to, const EnumerationItems& items) {
  if (from == to) return true;
  const auto target = range_of(to);
  const auto source = range_of(from);
  if (!source || !target) return false;
  if (is_real(from)) return from == ValueType::Float32 && to == ValueType::Float64;
  if (from == ValueType::Enumeration && !items.empty()) {
    return std::all_of(items.begin(), items.end(),
                       [&](const auto& item) { return target->holds(item.second); });
  }
  return target->holds(*source);
}

std::string boolean_conversion(ValueType from, ValueType to) {
  const auto is_plain_integer = [](ValueType type) {
    return is_integer(type) && type != ValueType::Enumeration;
  };
  if (from == ValueType::Boolean && (is_real(to) || is_plain_integer(to))) {
    return "true becomes 1, false 0";
  }
  if (is_plain_integer(from) && to == ValueType::Boolean) {
    return "0 becomes false, any other number true";
  }
  return "";
}

std::vector<PathConnector> completed(std::vector<PathConnector> path) {
  const auto inherit = [](PathConnector& to, const PathConnector& from) {
    if (!to.type) to.type = from.type;
    if (to.unit.name.empty() && to.type && is_real(*to.type)) to.unit = from.unit;
    if (to.items.empty() && to.type == ValueType::Enumeration) to.items = from.items;
  };
  for (std::size_t i = path.size() - 1; i-- > 0;) {
    if (path[i].takes_after_next) inherit(path[i], path[i + 1]);
  }
  for (std::size_t i = 1; i < path.size(); ++i) inherit(path[i], path[i - 1]);
  for (std::size_t i = path.size() - 1; i-- > 0;) {
    if (!path[i].type) inherit(path[i], path[i + 1]);
  }
  return path;
}

UnitOfMeasure first_unit(const std::vector<PathConnector>& path) {
  const auto first = std::ranges::find_if(path, has_unit);
  return first == path.end() ? UnitOfMeasure{} : first->unit;
}

UnitOfMeasure last_unit(const std::vector<PathConnector>& path) {
  const auto last = std::find_if(path.rbegin(), path.rend(), has_unit);
  return last == path.rend() ? UnitOfMeasure{} : last->unit;
}

bool mixes_differences(const std::vector<PathConnector>& path) {
  const std::optional<bool> from = path.front().is_relative;
  const std::optional<bool> to = path.back().is_relative;
  return from && to && *from != *to;
}

Conversion compose(const std::vector<PathConnector>& path, std::span<const PathSegment> segments,
                   const Context& context) {
  return Composer(path, segments, context).conversion();
}

TextConversion compose_text(const std::string& text, const std::vector<PathConnector>& path,
                            std::span<const PathSegment> segments, const Context& context,
                            bool is_integer) {
  const Composer composer(path, segments, context);
  const LinearConversion linear = composer.linear();
  return {composer.words(text, is_integer), linear};
}

}  // namespace stride::core
