// The clock of what drives a body. It may run faster or slower than the time of the body: a slow test is led through
// quickly where nothing happens, and the tables of its drives and loads stay as they are.
#pragma once

#include <concepts>
#include <type_traits>

namespace fpz::sph::detail {

struct LoadingClock {
  double pace = 1.0;    ///< seconds of this clock per second of the body, >= 0, from step `since` on
  double anchor = 0.0;  ///< s: what it showed at step `since`
  long long since = 0;

  /// s, at step n of `step` (s).
  [[nodiscard]] double at(long long n, double step) const {
    return anchor + pace * (static_cast<double>(n - since) * step);
  }
  /// Another pace from step n on.
  void change(double new_pace, long long n, double step) {
    anchor = at(n, step);
    since = n;
    pace = new_pace;
  }
};

template <class Archive, class C>
void transfer(Archive& archive, C& clock) requires std::same_as<std::remove_const_t<C>, LoadingClock> {
  auto& [pace, anchor, since] = clock;  // a member that is not handed on does not compile
  archive(pace), archive(anchor), archive(since);
}

}  // namespace fpz::sph::detail
