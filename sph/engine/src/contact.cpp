#include "contact.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "sort_unique.hpp"

namespace fpz::sph::detail {

namespace {

constexpr int most_sweeps = 100;
constexpr double settled = 1e-7;  // change of the forces in a sweep, of the largest: what is left is found a step later

}  // namespace

template <int Dim>
Contact<Dim>::Contact(RunData<Dim>& run, const Boundaries<Dim>& boundaries, const NeighbourLists& lists)
    : run_(run), lists_(lists), faces_(run, lists), points_(points_of_cuts(run)) {
  find_prescribed(boundaries);
  find_members();
}

/// A platen that yields to forces counts as prescribed too: it is heavier than the particles that meet it, and what
/// drives it comes after the contact.
template <int Dim>
void Contact<Dim>::find_prescribed(const Boundaries<Dim>& boundaries) {
  prescribed_.assign(run_.particles.padded(), 0);
  for (const auto& boundary : boundaries) boundary->mark_driven(prescribed_);
}

/// The particles of all faces, each once.
template <int Dim>
void Contact<Dim>::find_members() {
  std::vector<std::size_t> slots;
  for (const ContactPoint<Dim>& point : points_) {
    for (const FaceSide& side : point.side) slots.insert(slots.end(), side.particle.begin(), side.particle.end());
  }
  sort_unique(slots);
  members_.clear();
  for (const std::size_t i : slots) {
    Member& m = members_.emplace_back(Member{i, Vector::Zero(), Vector::Zero()});
    for (int c = 0; c < Dim; ++c) {
      if ((static_cast<unsigned>(prescribed_[i]) >> c & 1U) == 0) m.inverse_mass[c] = run_.particles.inverse_mass[i];
    }
  }
  places_.assign(points_.size(), {});
  for (std::size_t k = 0; k < points_.size(); ++k) add_shares(points_[k], slots, places_[k]);
}

/// A face turns as the mean of its sides does; single particles do not show that, nor a side without slopes.
template <int Dim>
void Contact<Dim>::add_shares(const ContactPoint<Dim>& point, const std::vector<std::size_t>& slots, Place& place) {
  const auto turns = [](const FaceSide& side) {
    return std::any_of(side.slope.begin(), side.slope.end(), [](double s) { return s != 0.0; }) ? 1.0 : 0.0;
  };
  const double sides = std::max(1.0, turns(point.side[0]) + turns(point.side[1]));
  for (std::size_t s = 0; s < 2; ++s) {
    const FaceSide& side = point.side[s];
    for (std::size_t k = 0; k < side.particle.size(); ++k) {
      const auto at = std::lower_bound(slots.begin(), slots.end(), side.particle[k]) - slots.begin();
      const double weight = s == 0 ? -side.weight[k] : side.weight[k];
      place.shares.push_back({static_cast<std::size_t>(at), weight, side.slope[k] / sides});
    }
  }
}

template <int Dim>
void Contact<Dim>::add(const std::vector<ReleasedBond<Dim>>& released) {
  changes_ = true;
  faces_.refit(released);
  refit(released);
  const std::size_t first = points_.size();
  std::vector<bool> pressed;
  for (const ReleasedBond<Dim>& bond : released) {
    auto point = point_of_bond(run_, lists_, bond);
    if (!point) continue;
    points_.push_back(std::move(*point));
    pressed.push_back(bond.pressed);
  }
  find_members();
  for (std::size_t k = first; k < points_.size(); ++k) begin(k, pressed[k - first]);
}

/// Points whose ends have lost bonds go on with the particles that are left, at the same gap and shift.
template <int Dim>
void Contact<Dim>::refit(const std::vector<ReleasedBond<Dim>>& released) {
  Mask touched(run_.particles.count, 0);
  for (const ReleasedBond<Dim>& bond : released) touched[bond.from] = touched[bond.to] = 1;
  std::vector<std::size_t> changed;
  std::vector<Place> before;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    ContactPoint<Dim>& point = points_[k];
    if (!point.of_crack || !point.at_start.isZero(0.0) ||
        (touched[point.side[0].particle[0]] | touched[point.side[1].particle[0]]) == 0)
      continue;
    look(point, places_[k]);
    changed.push_back(k);
    before.push_back(places_[k]);
    fit_sides_of_bond(run_, lists_, point);
  }
  go_on(changed, before);
}

/// So far that other particles are opposite now; or a part of that.
template <int Dim>
bool Contact<Dim>::has_slid(std::size_t k, double part) const {
  constexpr double far = 0.5;  // spacings
  const double spacing = run_.setup.arrangement.spacing;
  return !points_[k].of_face && std::abs(places_[k].shift) > part * far * spacing && part * places_[k].gap < spacing;
}

/// Looks a step ahead: what jumps further in a step is found in the step after. Points between faces that have met may
/// always find others.
template <int Dim>
bool Contact<Dim>::may_change() const {
  constexpr double nearly = 0.9;
  bool any = faces_.search_is_due(nearly);
  for (std::size_t k = 0; k < points_.size(); ++k) any = any || points_[k].of_face || has_slid(k, nearly);
  return any;
}

template <int Dim>
bool Contact<Dim>::presses() const {
  return std::any_of(points_.begin(), points_.end(), [](const auto& point) { return point.pressure > 0.0; });
}

template <int Dim>
bool Contact<Dim>::follow_slip() {
  bool any = false;
  for (std::size_t k = 0; k < points_.size(); ++k) any = any || has_slid(k);
  if (!any) return false;
  std::vector<ContactPoint<Dim>> left;
  std::vector<std::size_t> changed;
  std::vector<Place> before;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    ContactPoint<Dim>& point = points_[k];
    if (has_slid(k)) {
      const double slid = places_[k].shift;
      auto side = side_opposite(run_, point, slid);
      if (!side) continue;
      point.side[1] = std::move(*side);
      point.at_start -= slid * Vector(-point.normal[1], point.normal[0]);
      changed.push_back(left.size());
      before.push_back(places_[k]);
    }
    left.push_back(std::move(point));
  }
  points_ = std::move(left);
  go_on(changed, before);
  return true;
}

/// Points of faces that press on each other go on at their gap and slip with what is opposite now; those of open ones
/// begin anew.
template <int Dim>
bool Contact<Dim>::meet() {
  if (!faces_.search_is_due()) return false;
  std::vector<ContactPoint<Dim>> others;
  std::map<std::size_t, std::pair<ContactPoint<Dim>, Place>> pressing;  // of the particle of the face
  bool any = false;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    ContactPoint<Dim>& point = points_[k];
    any = any || point.of_face;
    if (!point.of_face) {
      others.push_back(std::move(point));
    } else if (point.pressure > 0.0) {
      const std::size_t face = point.side[0].particle[0];
      pressing.emplace(face, std::pair(std::move(point), std::move(places_[k])));
    }
  }
  std::vector<ContactPoint<Dim>> found = faces_.search(others);
  points_ = std::move(others);
  if (!any && found.empty()) return false;
  std::vector<std::size_t> going_on, fresh;
  std::vector<Place> before;
  for (ContactPoint<Dim>& point : found) {
    const auto same = pressing.find(point.side[0].particle[0]);
    if (same == pressing.end()) {
      fresh.push_back(points_.size());
    } else {
      const ContactPoint<Dim>& old = same->second.first;
      point.room = old.room, point.slip = old.slip, point.pressure = old.pressure, point.shear = old.shear;
      going_on.push_back(points_.size());
      before.push_back(std::move(same->second.second));
    }
    points_.push_back(std::move(point));
  }
  go_on(going_on, before);
  for (const std::size_t k : fresh) begin(k, false);
  return true;
}

/// A new point: it has no slip, and faces that overlap already touch.
template <int Dim>
void Contact<Dim>::begin(std::size_t k, bool touches) {
  ContactPoint<Dim>& point = points_[k];
  look(point, places_[k]);
  if (touches || places_[k].gap < 0.0) point.room -= places_[k].gap;
}

/// Moves the place on side 1 to where it is opposite the face now. The two forces of a point in one line make no
/// moment.
template <int Dim>
void Contact<Dim>::follow(ContactPoint<Dim>& point, Place& place) const {
  FaceSide& side = point.side[1];
  if (side.particle.size() < 2 || place.gap > run_.setup.arrangement.spacing) return;
  const double slid = place.shift;
  const std::size_t first = point.side[0].particle.size();
  for (std::size_t k = 0; k < side.particle.size(); ++k) {  // weights and slopes are right for linear fields
    const std::size_t i = side.particle[k];
    side.weight[k] -= slid * side.slope[k];
    place.shares[first + k].weight = side.weight[k];
    point.at_start -= slid * side.slope[k] * Vector(run_.particles.start[0][i], run_.particles.start[1][i]);
  }
  look(point, place);
  point.slip += place.shift - slid;
}

template <int Dim>
void Contact<Dim>::go_on(const std::vector<std::size_t>& changed, const std::vector<Place>& before) {
  find_members();
  for (std::size_t n = 0; n < changed.size(); ++n) {
    ContactPoint<Dim>& point = points_[changed[n]];
    Place& place = places_[changed[n]];
    look(point, place);
    point.room += before[n].gap - place.gap;
    point.slip += place.shift - before[n].shift;
  }
}

template <int Dim>
void Contact<Dim>::look(const ContactPoint<Dim>& point, Place& place) const {
  const Particles<Dim>& p = run_.particles;
  Vector distance = point.at_start, slope = Vector::Zero();
  for (const Share& s : place.shares) {
    const std::size_t i = members_[s.member].slot;
    const Vector u(p.position[0][i] - p.start[0][i], p.position[1][i] - p.start[1][i]);
    distance += s.weight * u;
    slope += s.slope * u;
  }
  const Vector along = Vector(-point.normal[1], point.normal[0]) + slope;
  const double length = along.norm();
  const Vector tangent = along / length;
  const Vector normal(tangent[1], -tangent[0]);
  const double apart = normal.dot(distance);
  place.gap = apart + point.room;
  place.shift = tangent.dot(distance);
  for (Share& s : place.shares) {
    s.press = (s.weight - place.shift * s.slope / length) * normal;
    s.drag = s.weight * tangent + (apart * s.slope / length) * normal;
  }
}

template <int Dim>
void Contact<Dim>::look_at_all() {
  for (std::size_t k = 0; k < points_.size(); ++k) look(points_[k], places_[k]);
}

template <int Dim>
void Contact<Dim>::find_motion(Place& place) const {
  const Particles<Dim>& p = run_.particles;
  place.closing = place.sliding = 0.0;
  for (const Share& s : place.shares) {
    const std::size_t i = members_[s.member].slot;
    const Vector way = run_.dt * Vector(p.velocity[0][i], p.velocity[1][i]);
    place.closing += s.press.dot(way);
    place.sliding += s.drag.dot(way);
  }
}

template <int Dim>
void Contact<Dim>::book() {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    find_motion(places_[k]);
    taken_ += half_work(points_[k], places_[k]);
  }
}

template <int Dim>
void Contact<Dim>::prepare() {
  look_at_all();
  if (changes_) {
    const bool slid = follow_slip();
    if (meet() || slid) look_at_all();
  }
  for (std::size_t k = 0; k < points_.size(); ++k) {
    ContactPoint<Dim>& point = points_[k];
    point.slip = point.law.slip_at(places_[k].gap, places_[k].shift, point.slip);
    if (point.of_face) follow(point, places_[k]);
    if (run_.started) find_motion(places_[k]);
  }
  changes_ = may_change();
}

template <int Dim>
void Contact<Dim>::push() {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    for (const Share& s : places_[k].shares) {
      const Vector force = points_[k].pressure * s.press + points_[k].shear * s.drag;
      for (std::size_t c = 0; c < run_.dimensions; ++c) {
        run_.outer_force[c][members_[s.member].slot] += force[static_cast<int>(c)];
      }
    }
  }
}

/// Velocities at n + 1/2 as they are without what is still to be found. Prescribed ones go on as before the kick.
template <int Dim>
void Contact<Dim>::predict(double step) {
  const Particles<Dim>& p = run_.particles;
  for (Member& m : members_) {
    for (int c = 0; c < Dim; ++c) {
      const auto k = static_cast<std::size_t>(c);
      const double taken_back = m.inverse_mass[c] == 0.0 ? step * p.acceleration[k][m.slot] : 0.0;
      m.velocity[c] = p.velocity[k][m.slot] - taken_back;
    }
  }
}

template <int Dim>
void Contact<Dim>::find_gives(Place& place, double step) const {
  place.normal_give = place.shear_give = 0.0;
  for (const Share& s : place.shares) {
    const Vector give = step * run_.dt * members_[s.member].inverse_mass;
    place.normal_give += s.press.cwiseAbs2().dot(give);
    place.shear_give += s.drag.cwiseAbs2().dot(give);
  }
}

template <int Dim>
double Contact<Dim>::correct(ContactPoint<Dim>& point, const Place& place, double step) {
  double opening = 0.0, sliding = 0.0;  // m/s
  for (const Share& s : place.shares) {
    opening += s.press.dot(members_[s.member].velocity);
    sliding += s.drag.dot(members_[s.member].velocity);
  }
  // Without the forces of this point.
  const double gap = place.gap + run_.dt * opening - place.normal_give * point.pressure;
  const double shift = place.shift + run_.dt * sliding - place.shear_give * point.shear;
  const double pressure = point.law.implicit_pressure(gap, place.normal_give);
  if (point.pressure == 0.0 && pressure == 0.0) return 0.0;
  const double shear = point.law.implicit_shear(shift - point.slip, place.shear_give, pressure);
  const double more = pressure - point.pressure, more_shear = shear - point.shear;
  for (const Share& s : place.shares) {
    Member& m = members_[s.member];
    m.velocity += step * m.inverse_mass.cwiseProduct(more * s.press + more_shear * s.drag);
  }
  point.pressure = pressure;
  point.shear = shear;
  return std::abs(more) + std::abs(more_shear);
}

/// What was found goes to the particles, less the forces of the step before, which they have. The work of a force is
/// that of the leap-frog: half with the velocity before it, half with the one after it (book()).
template <int Dim>
void Contact<Dim>::apply(ContactPoint<Dim>& point, const Place& place, double step) {
  Particles<Dim>& p = run_.particles;
  taken_ += half_work(point, place);
  const double more = point.pressure - place.pressure, more_shear = point.shear - place.shear;
  if (more == 0.0 && more_shear == 0.0) return;
  for (const Share& s : place.shares) {
    const std::size_t i = members_[s.member].slot;
    const Vector acceleration = p.inverse_mass[i] * (more * s.press + more_shear * s.drag);
    for (int c = 0; c < Dim; ++c) {
      const auto k = static_cast<std::size_t>(c);
      p.acceleration[k][i] += acceleration[c];
      p.velocity[k][i] += step * acceleration[c];
    }
  }
}

template <int Dim>
void Contact<Dim>::act(double step) {
  if (points_.empty()) return;
  predict(step);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    find_gives(places_[k], step);
    places_[k].pressure = points_[k].pressure;
    places_[k].shear = points_[k].shear;
  }
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    double change = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < points_.size(); ++k) {
      change = std::max(change, correct(points_[k], places_[k], step));
      largest = std::max(largest, points_[k].pressure);
    }
    if (!(change > settled * largest)) break;
  }
  for (std::size_t k = 0; k < points_.size(); ++k) apply(points_[k], places_[k], step);
}

template <int Dim>
double Contact<Dim>::stored() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const ContactPoint<Dim>& point = points_[k];
    Place place = places_[k];
    look(point, place);
    sum += point.law.stored(place.gap, place.shift, point.law.slip_at(place.gap, place.shift, point.slip));
  }
  return sum;
}

template <int Dim>
double Contact<Dim>::overlap() const {
  double most = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Place place = places_[k];
    look(points_[k], place);
    most = std::max(most, -place.gap);
  }
  return most;
}

template <int Dim>
void Contact<Dim>::save(Writer& archive) const {
  archive(taken_);
  archive(points_);
  faces_.save(archive);
}

template <int Dim>
void Contact<Dim>::load(Reader& archive) {
  archive(taken_);
  archive(points_);
  faces_.load(archive);
  find_members();
  look_at_all();
  changes_ = may_change();
}

template class Contact<2>;

}  // namespace fpz::sph::detail
