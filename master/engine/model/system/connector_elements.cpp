#include "master/engine/model/system/connector_elements.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "master/engine/model/array_element.h"

namespace stride::core {
namespace {

/// The scalars of an array, by their indices.
using Scalars = std::map<std::vector<std::size_t>, std::size_t>;

[[noreturn]] void fail_parts(const Context& context, const std::string& reason,
                             const std::string& hint = "name them one by one") {
  fail_input(context,
             fmt::format("the unit has no array '{0}', but scalars '{0}[…]', and {1}",
                         context.variable, reason),
             hint);
}

Scalars find_scalars(const NameIndex& names, std::size_t component,
                     const UnitDescription& description, const Context& context) {
  Scalars scalars;
  for (const auto& [name, place] : names.variables(component, context.variable + "[")) {
    const std::optional<IndexedName> indexed = indexed_name(std::string(name));
    if (!indexed || indexed->array != context.variable || indexed->indices.empty()) continue;
    if (!description.variables[place].dimensions.empty()) {
      fail_parts(context, fmt::format("'{}' is an array itself", name));
    }
    scalars.emplace(indexed->indices, place);
  }
  return scalars;
}

/// The largest index of each dimension.
std::vector<std::size_t> dimensions_of(const Scalars& scalars, const Context& context) {
  std::vector<std::size_t> dimensions(scalars.begin()->first.size());
  for (const auto& [indices, place] : scalars) {
    if (indices.size() != dimensions.size()) {
      fail_parts(context, "not all of them have the same number of indices");
    }
    for (std::size_t i = 0; i < indices.size(); ++i) {
      if (indices[i] == 0) {
        fail_parts(context, "some have the index 0",
                   "indices of an array start at 1; name them one by one");
      }
      dimensions[i] = std::max(dimensions[i], indices[i]);
    }
  }
  return dimensions;
}

/// They are sorted as the elements of the array, so the first one that is missing is where they
/// differ from it.
void check_complete(const Scalars& scalars, std::span<const std::size_t> dimensions,
                    const Context& context) {
  std::size_t element = 0;
  for (const auto& [indices, place] : scalars) {
    const std::string expected = element_name(context.variable, dimensions, element++);
    if (indexed_name(expected)->indices == indices) continue;
    fail_parts(context, fmt::format("'{}' is not among them", expected));
  }
  std::vector<Dimension> all(dimensions.begin(), dimensions.end());
  if (element_count(all) == scalars.size()) return;
  fail_parts(context, fmt::format("'{}' is not among them",
                                  element_name(context.variable, dimensions, element)));
}

/// Of "x[2][1]", where `x` is the array.
void check_indexed_once(const NameIndex& names, std::size_t component, const IndexedName& name,
                        const Context& context) {
  const std::optional<IndexedName> element = indexed_name(name.array);
  if (!element || !names.variable(component, element->array)) return;
  fail_input(context,
             fmt::format("'{}' is an element of the array '{}' already, and it has no element {}",
                         name.array, element->array, name.brackets),
             "give the indices once; startIndices and endIndices of a connection mean the same as "
             "indices behind its names");
}

}  // namespace

std::string shape_text(const ConnectorElements& elements) {
  if (elements.dimensions.empty()) return "a scalar";
  return fmt::format("{} of {}", elements.are_scalars() ? "scalars" : "an array",
                     elements_text(elements.dimensions));
}

std::optional<ConnectorElements> find_elements(const NameIndex& names, std::size_t component,
                                               const UnitDescription& description,
                                               const Context& context) {
  if (const auto place = names.variable(component, context.variable)) {
    const Variable& variable = description.variables[*place];
    return ConnectorElements{{{{component, *place}, 0, variable.size}}, sizes(variable)};
  }
  if (const auto indexed = indexed_name(context.variable)) {
    const auto array = names.variable(component, indexed->array);
    if (!array) {
      check_indexed_once(names, component, *indexed, context);
      return std::nullopt;
    }
    const std::size_t first = element_at(description.variables[*array], *indexed, context);
    return ConnectorElements{{{{component, *array}, first, 1}}, {}};
  }
  const Scalars scalars = find_scalars(names, component, description, context);
  if (scalars.empty()) return std::nullopt;
  ConnectorElements found{{}, dimensions_of(scalars, context)};
  check_complete(scalars, found.dimensions, context);
  for (const auto& [indices, place] : scalars) found.parts.push_back({{component, place}, 0, 1});
  return found;
}

}  // namespace stride::core
