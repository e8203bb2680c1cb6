#include "fpz/specimen/closure.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace fpz::specimen {
namespace {

/// A particle of the row beside a face.
struct Beside {
  double along, normal;  ///< m: place along the notch, displacement to its left
};

}  // namespace

double face_overlap(const Notch& n, const std::vector<Point>& start, const std::vector<Point>& displacement,
                    double spacing) {
  constexpr double row = 1.0, opposite = 0.75;  // spacings
  const double length = (n.tip - n.mouth).norm(), width = std::max(n.width, n.asked_width);
  std::vector<Beside> left, right;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const Point x = start[i] - n.mouth;
    const double s = along(n).dot(x), d = across(n).dot(x);
    if (s < 0.0 || s > length || std::abs(d) > 0.5 * n.width + row * spacing) continue;
    (d > 0.0 ? left : right).push_back({s, across(n).dot(displacement[i])});
  }
  double largest = 0.0;
  for (const Beside& l : left) {
    const auto r = std::min_element(right.begin(), right.end(), [&](const Beside& a, const Beside& b) {
      return std::abs(a.along - l.along) < std::abs(b.along - l.along);
    });
    if (r == right.end() || std::abs(r->along - l.along) > opposite * spacing) continue;
    largest = std::max(largest, r->normal - l.normal - width);
  }
  return largest;
}

std::string warning_of_closure(const std::vector<double>& overlap, double spacing) {
  constexpr double noticed = 1e-3;  // spacings
  std::ostringstream s;
  s.precision(3);
  for (std::size_t k = 0; k < overlap.size(); ++k) {
    if (overlap[k] <= noticed * spacing) continue;
    s << (s.str().empty() ? "" : "; ") << "the faces of notch " << k << " are " << 1e6 * overlap[k]
      << " um inside each other";
  }
  if (s.str().empty()) return "";
  return s.str() +
         ": they should press on each other, but nothing passes between them, so that the specimen is too soft and too "
         "weak; \"configuration\": \"reference\" with a contact_stiffness above 0 has contact; or leave out a notch "
         "that is "
         "closed, or give it the width that it has";
}

std::string warning_of_overlap(double overlap, double spacing) {
  constexpr double noticed = 1e-2;  // spacings
  if (!(overlap > noticed * spacing)) return "";
  std::ostringstream s;
  s.precision(3);
  s << "faces in contact are " << 1e6 * overlap << " um inside each other, " << 100.0 * overlap / spacing
    << " % of a spacing: contact_stiffness is too small for this pressure";
  return s.str();
}

}  // namespace fpz::specimen
