#include "team.hpp"

namespace fpz::sph::detail {

namespace {

constexpr std::uint64_t bits = 20;
constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
constexpr std::uint64_t pass_mask = (std::uint64_t{1} << (64 - 2 * bits)) - 1;

std::uint64_t packed(std::uint64_t pass, std::uint64_t begin, std::uint64_t end) {
  return (pass & pass_mask) << (2 * bits) | begin << bits | end;
}

/// Rounds of waiting: with a pause, some microseconds, as long as between two passes of a step; then giving the
/// processor away, as long as between two steps; then asleep.
constexpr int pauses = 500;
constexpr int yields = 200;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

Team::~Team() {
  over_.store(true);
  pass_.fetch_add(1);
  pass_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Team::start() {
  strips_ = std::make_unique<Strip[]>(static_cast<std::size_t>(size_));
  for (int rank = 1; rank < size_; ++rank)
    threads_.emplace_back([this, rank] { serve(static_cast<std::size_t>(rank)); });
}

void Team::run_on_all(std::int64_t count, Call call, void* work) {
  if (threads_.empty()) start();
  const auto size = static_cast<std::uint64_t>(size_), pieces = static_cast<std::uint64_t>(count);
  const std::uint32_t pass = pass_.load(std::memory_order_relaxed) + 1;
  // First nothing of the last pass can be taken any more, then what is to be done changes, then there is work.
  for (std::uint64_t r = 0; r < size; ++r) strips_[r].left.store(packed(pass, 0, 0));
  call_.store(call);
  work_.store(work);
  undone_.store(count);
  for (std::uint64_t r = 0; r < size; ++r) {
    strips_[r].left.store(packed(pass, pieces * r / size, pieces * (r + 1) / size));
  }
  pass_.store(pass);
  if (asleep_.load() > 0) pass_.notify_all();
  work_on(0);
  for (int k = 0; undone_.load(std::memory_order_acquire) > 0; ++k) {
    if (k < pauses) {
      pause();
    } else {
      std::this_thread::yield();
    }
  }
}

std::int64_t Team::take(Strip& strip, bool from_front) {
  std::uint64_t left = strip.left.load();
  for (;;) {
    const std::uint64_t begin = left >> bits & mask, end = left & mask;
    if (begin >= end) return -1;
    const std::uint64_t rest = from_front ? left + (std::uint64_t{1} << bits) : left - 1;
    if (strip.left.compare_exchange_weak(left, rest)) return static_cast<std::int64_t>(from_front ? begin : end - 1);
  }
}

void Team::work_on(std::size_t rank) {
  const auto size = static_cast<std::size_t>(size_);
  for (std::size_t k = 0; k < size; ++k) {
    Strip& strip = strips_[(rank + k) % size];
    for (std::int64_t piece = take(strip, k == 0); piece >= 0; piece = take(strip, k == 0)) {
      // The piece is of the present pass, which cannot end before it is done: what to do stays.
      call_.load()(work_.load(), piece);
      undone_.fetch_sub(1, std::memory_order_release);
    }
  }
}

void Team::wait_for_work(std::uint32_t done) {
  for (int k = 0; k < pauses; ++k) {
    if (pass_.load() != done) return;
    pause();
  }
  for (int k = 0; k < yields; ++k) {
    if (pass_.load() != done) return;
    std::this_thread::yield();
  }
  asleep_.fetch_add(1);
  pass_.wait(done);
  asleep_.fetch_sub(1);
}

void Team::serve(std::size_t rank) {
  std::uint32_t done = 0;
  for (;;) {
    wait_for_work(done);
    if (over_.load()) return;
    done = pass_.load();
    work_on(rank);
  }
}

}  // namespace fpz::sph::detail
