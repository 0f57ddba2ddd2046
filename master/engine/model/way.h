// What a value comes through, from its beginning on.
#ifndef STRIDE_MASTER_ENGINE_MODEL_WAY_H
#define STRIDE_MASTER_ENGINE_MODEL_WAY_H

#include <utility>
#include <vector>

#include "master/engine/model/conversion.h"
#include "master/engine/model/system_declaration.h"

namespace stride::core {

/// The connectors and the segments between them, as compose() takes them.
struct Way {
  std::vector<PathConnector> path;
  std::vector<PathSegment> segments{};

  explicit Way(PathConnector first) : path{std::move(first)} {}

  template <class Declaration>
  void go(const Declaration& wanted, PathConnector last) {
    for (const ViaDeclaration& via : wanted.via) go(via.connector, via.segment);
    go(std::move(last), PathSegment{wanted.suppress_unit_conversion, wanted.transformation});
  }
  void go(PathConnector next, PathSegment segment) {
    path.push_back(std::move(next));
    segments.push_back(std::move(segment));
  }
};

}  // namespace stride::core

#endif
