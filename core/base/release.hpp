#pragma once
#include <vector>

namespace signorini {

/// Empties a vector and gives its memory back. (Assigning {} keeps it: that is an empty list of values.)
template <class T>
void release(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

}  // namespace signorini
