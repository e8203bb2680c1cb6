// Layout: magic, fields in the order below (lengths before contents), FNV-1a of all before. Native byte order.
#include <cstdint>
#include <cstring>

#include "fpz/io/json_locator.hpp"
#include "fpz/io/output.hpp"
#include "fpz/specimen/run.hpp"

namespace fpz::specimen {
namespace {

constexpr std::uint64_t magic = 0x31305055524b4346ULL;

std::uint64_t fnv(std::string_view bytes) {
  std::uint64_t h = 14695981039346656037ULL;
  for (const char b : bytes) h = (h ^ static_cast<unsigned char>(b)) * 1099511628211ULL;
  return h;
}

class Out {
 public:
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(const T& x) { bytes.append(reinterpret_cast<const char*>(&x), sizeof x); }
  template <class C>
  requires requires(C c) { c.size(); }
  void operator()(const C& values) {
    (*this)(static_cast<std::uint64_t>(values.size()));
    for (const auto& v : values) (*this)(v);
  }
  void operator()(const Frame& f) {
    (*this)(f.time);
    (*this)(f.file);
  }
  std::string bytes;
};

class In {
 public:
  explicit In(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  requires std::is_arithmetic_v<T>
  void operator()(T& x) {
    if (bytes_.size() < sizeof x) throw io::InputError("it is too short");
    std::memcpy(&x, bytes_.data(), sizeof x);
    bytes_.remove_prefix(sizeof x);
  }
  template <class C>
  requires requires(C c) { c.size(); }
  void operator()(C& values) {
    std::uint64_t n = 0;
    (*this)(n);
    if (n > bytes_.size()) throw io::InputError("a length in it is wrong");
    values.resize(n);
    for (auto& v : values) (*this)(v);
  }
  void operator()(Frame& f) {
    (*this)(f.time);
    (*this)(f.file);
  }

 private:
  std::string_view bytes_;
};

template <class Archive, class C>
void transfer(Archive& a, C& c) {
  a(c.scene_text);
  a(c.record.history.columns);
  a(c.record.history.values);
  a(c.record.frames);
  a(c.record.window);
  a(c.record.window_steps);
  a(c.record.peak_load);
  a(c.record.levels_done);
  a(c.record.stepping_seconds);
  a(c.record.wall_seconds);
  a(c.state);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& file, const Checkpoint& checkpoint) {
  Out out;
  out(magic);
  transfer(out, checkpoint);
  out(fnv(out.bytes));
  io::write_text(file, out.bytes, true);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  io::ReadLimits limits;
  limits.bytes = std::size_t{64} << 30;
  std::string text, error;
  if (!io::load_text(file, io::FileKind::regular, limits, text, error)) {
    throw io::InputError(file.string() + ": no checkpoint to resume from: " + error);
  }
  Checkpoint c;
  try {
    std::uint64_t number = 0;
    In in(text);
    in(number);
    if (number != magic) throw io::InputError("it is not a checkpoint of this version");
    if (text.size() < 16) throw io::InputError("it is too short");
    std::uint64_t sum = 0;
    std::memcpy(&sum, text.data() + text.size() - 8, 8);
    if (sum != fnv(std::string_view(text).substr(0, text.size() - 8))) throw io::InputError("its checksum is wrong");
    transfer(in, c);
  } catch (const io::InputError& e) {
    throw io::InputError(file.string() + ": the checkpoint cannot be used: " + e.what());
  }
  return c;
}

}  // namespace fpz::specimen
