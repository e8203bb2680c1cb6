// The threads of a run: one team for its whole life. Pieces of work are dealt out in strips, one for each thread, the
// same in every pass, so that a thread finds its particles in its cache; who has finished takes from the others. A pass
// ends when its pieces are done, not when all threads have come: one that the system keeps from running delays the
// others by the piece in its hands at most. Waiting yields the processor.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <thread>
#include <type_traits>
#include <vector>

namespace fpz::sph::detail {

class Team {
 public:
  /// A team of `size` threads, the caller's among them; the others start with the first work.
  explicit Team(int size) : size_(size < 1 ? 1 : size) {}
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Calls f(k) for k = 0 ... count - 1, each once, in any order and on any thread; returns when all have returned.
  /// Not from two threads at a time, and not from within f. f must not throw.
  template <class F>
  void run(std::int64_t count, F&& f) {
    if (size_ == 1 || count < 2 || count > most_pieces) {
      for (std::int64_t k = 0; k < count; ++k) f(k);
      return;
    }
    run_on_all(
        count, [](void* work, std::int64_t k) { (*static_cast<std::remove_reference_t<F>*>(work))(k); },
        const_cast<void*>(static_cast<const void*>(&f)));
  }

 private:
  using Call = void (*)(void*, std::int64_t);
  static constexpr std::int64_t most_pieces = (1 << 20) - 1;

  /// What is left of a thread's strip, [begin, end), and the number of the pass it belongs to: in one word, so that a
  /// piece of a pass that is over cannot be taken.
  struct alignas(64) Strip {
    std::atomic<std::uint64_t> left{0};
  };

  void run_on_all(std::int64_t count, Call call, void* work);
  void start();
  void wait_for_work(std::uint32_t done);
  void serve(std::size_t rank);
  /// Takes pieces, first of the own strip, then of the others', until none is left.
  void work_on(std::size_t rank);
  [[nodiscard]] std::int64_t take(Strip& strip, bool from_front);

  int size_;
  std::vector<std::thread> threads_;
  std::unique_ptr<Strip[]> strips_;
  std::atomic<Call> call_{nullptr};
  std::atomic<void*> work_{nullptr};
  alignas(64) std::atomic<std::uint32_t> pass_{0};  ///< number of the last one
  std::atomic<int> asleep_{0};
  std::atomic<bool> over_{false};
  alignas(64) std::atomic<std::int64_t> undone_{0};  ///< pieces
};

}  // namespace fpz::sph::detail
