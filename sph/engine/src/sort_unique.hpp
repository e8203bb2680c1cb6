#pragma once

#include <algorithm>
#include <vector>

namespace fpz::sph::detail {

/// Sorts a list and leaves one of each that are equal.
template <class T>
void sort_unique(std::vector<T>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace fpz::sph::detail
