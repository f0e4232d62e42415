#pragma once
#include <vector>

#include "core/scene/scene.hpp"

namespace signorini {

/// The numbers of the tables, of one kind, that belong to a body or its parts: fixes, loads, obstacles or probes.
template <class Table>
std::vector<int> numbers_of(const std::vector<Table>& tables, const Scene::Body& body) {
  std::vector<int> numbers;
  for (std::size_t k = 0; k < tables.size(); ++k)
    if (body.answers_to(tables[k].body)) numbers.push_back(static_cast<int>(k));
  return numbers;
}

}  // namespace signorini
