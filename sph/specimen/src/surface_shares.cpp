#include "fpz/specimen/surface_shares.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fpz/sph/linear_fit.hpp"
#include "point_grid.hpp"

namespace fpz::specimen {
namespace {

using detail::PointGrid;
using Values = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

constexpr double reach = 3.0;      // spacings: depth to which particles take a traction
constexpr double touches = 0.75;   // spacings: between a surface and the first row of a group on it
constexpr int refinements = 5;     // of the solution: its matrix is a little softer than it should be
constexpr double disturbed = 3.5;  // spacings from groups and cuts: area vectors are not those of the surface alone

std::vector<SurfacePiece> pieces_of(const Body& body, const sph::Arrangement<2>& a) {
  std::vector<SurfacePiece> all;
  for (const std::vector<Point>& line : a.surface) {
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      SurfacePiece piece;
      piece.from = line[k], piece.to = line[k + 1];
      const Point d = (piece.to - piece.from).normalized();
      piece.normal = Point(d[1], -d[0]);
      if (contains(body, piece.middle() + 0.01 * a.spacing * piece.normal)) piece.normal *= -1.0;
      all.push_back(piece);
    }
  }
  return all;
}

std::vector<Point> group_particles(const sph::Arrangement<2>& a) {
  std::vector<Point> all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a.group[i] != sph::Arrangement<2>::specimen) all.push_back(a.position[i]);
  }
  return all;
}

/// Place of a particle seen from a piece, in units of the reach.
Point seen_from(const SurfacePiece& piece, const Point& x, double spacing) {
  return (x - piece.middle()) / (reach * spacing);
}

double bell(const Point& seen) { return std::pow(std::max(0.0, 1.0 - seen.squaredNorm()), 2); }

/// Adds what is linear in the place times a bell and the volume to the weights, so that their sum and moment are those
/// of the piece.
void balance(SurfacePiece& piece, const sph::Arrangement<2>& a) {
  std::vector<Point> seen;
  std::vector<double> volume;
  Eigen::Vector3d lacking = Eigen::Vector3d::UnitX();
  for (const SurfacePiece::Share& s : piece.shares) {
    const Point x = seen.emplace_back(seen_from(piece, a.position[s.particle], a.spacing));
    volume.push_back(a.volume[s.particle]);
    lacking -= s.weight * Eigen::Vector3d(1.0, x[0], x[1]);
  }
  const sph::LinearFit fit(seen, volume);
  if (!fit.is_determined()) {
    throw std::invalid_argument("a load acts on a surface where there are no particles to take it");
  }
  const std::vector<double> more = fit.weights(lacking);
  for (std::size_t n = 0; n < more.size(); ++n) piece.shares[n].weight += more[n];
}

/// Particles whose area vectors are those of the pieces alone.
std::vector<bool> undisturbed(const std::vector<SurfacePiece>& pieces, const sph::Arrangement<2>& a) {
  std::vector<bool> yes(a.size(), false);
  for (const SurfacePiece& piece : pieces) {
    for (const SurfacePiece::Share& s : piece.shares) yes[s.particle] = true;
  }
  const double radius = disturbed * a.spacing;
  const std::vector<Point> others = group_particles(a);
  const PointGrid grid(others, radius);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!yes[i]) continue;
    grid.near(a.position[i], radius, [&](std::size_t) { yes[i] = false; });
    for (const sph::Cut<2>& cut : a.cuts) {
      const Point& x = a.position[i];
      if ((x - nearest_on(cut.corner[0], cut.corner[1], x)).norm() < radius) yes[i] = false;
    }
  }
  return yes;
}

/// Changes the shares as little as possible, in the sum of squares over the smooth weights' size, so that they add up
/// to the area vectors of the undisturbed particles and sums and moments stay.
void fit_to_areas(std::vector<SurfacePiece>& pieces, const sph::Arrangement<2>& a, const std::vector<Point>& area) {
  const std::vector<bool> fitted = undisturbed(pieces, a);
  std::vector<Eigen::Index> row(a.size(), -1);
  Eigen::Index rows = 3 * static_cast<Eigen::Index>(pieces.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (fitted[i]) row[i] = rows, rows += 2;
  }
  Values lacking = Values::Zero(rows);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (fitted[i]) lacking.segment<2>(row[i]) = area[i] / a.spacing;
  }
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> freedom;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Point vector = pieces[k].length() / a.spacing * pieces[k].normal;
    for (const SurfacePiece::Share& s : pieces[k].shares) {
      const auto column = static_cast<int>(freedom.size());
      const auto first = static_cast<int>(3 * k);
      const Point x = seen_from(pieces[k], a.position[s.particle], a.spacing);
      freedom.push_back(bell(x) + 1e-6);
      entries.emplace_back(first, column, 1.0);
      entries.emplace_back(first + 1, column, x[0]);
      entries.emplace_back(first + 2, column, x[1]);
      if (row[s.particle] < 0) continue;
      const auto at = static_cast<int>(row[s.particle]);
      entries.emplace_back(at, column, vector[0]);
      entries.emplace_back(at + 1, column, vector[1]);
      lacking.segment<2>(row[s.particle]) -= s.weight * vector;
    }
  }
  const Values d = Eigen::Map<const Values>(freedom.data(), static_cast<Eigen::Index>(freedom.size()));
  Matrix constraints(rows, d.size());
  constraints.setFromTriplets(entries.begin(), entries.end());
  Matrix normal = constraints * d.asDiagonal() * constraints.transpose();
  // Sums of all area vectors and of all pieces agree only as far as the chords of an arc do, and the same thing is said
  // twice: a little softness decides.
  for (Eigen::Index r = 0; r < rows; ++r) normal.coeffRef(r, r) += 1e-9;
  const Eigen::SimplicialLDLT<Matrix> factors(normal);
  if (factors.info() != Eigen::Success) throw std::invalid_argument("the surface of the body cannot take a load");
  Values change = Values::Zero(d.size());
  for (int k = 0; k < refinements; ++k) {
    change += d.cwiseProduct(constraints.transpose() * factors.solve(lacking - constraints * change));
  }
  Eigen::Index n = 0;
  for (SurfacePiece& piece : pieces) {
    for (SurfacePiece::Share& s : piece.shares) s.weight += change[n++];
    if (!piece.covered) balance(piece, a);  // what the softness has left
  }
}

}  // namespace

std::vector<SurfacePiece> share_surface(const Body& body, const sph::Arrangement<2>& a,
                                        const std::vector<Point>& area_vectors) {
  std::vector<SurfacePiece> pieces = pieces_of(body, a);
  const PointGrid grid(a.position, reach * a.spacing);
  const std::vector<Point> others = group_particles(a);
  const PointGrid covers(others, a.spacing);
  for (SurfacePiece& piece : pieces) {
    covers.near(piece.middle(), touches * a.spacing, [&](std::size_t) { piece.covered = true; });
    if (piece.covered) continue;
    grid.near(piece.middle(), reach * a.spacing, [&](std::size_t i) {
      if (a.group[i] == sph::Arrangement<2>::specimen) piece.shares.push_back({i, 0.0});
    });
    balance(piece, a);
  }
  fit_to_areas(pieces, a, area_vectors);
  return pieces;
}

double part_inside(const SurfacePiece& piece, const std::function<bool(const Point&)>& inside) {
  const bool begins = inside(piece.from), ends = inside(piece.to);
  if (begins == ends) return begins ? 1.0 : 0.0;
  double same = 0.0, other = 1.0;  // along the piece: as at its begin, as at its end
  for (int n = 0; n < 50; ++n) {
    const double middle = 0.5 * (same + other);
    (inside(piece.from + middle * (piece.to - piece.from)) == begins ? same : other) = middle;
  }
  return begins ? same : 1.0 - same;
}

std::vector<Point> forces_of(const std::vector<SurfacePiece>& pieces, std::size_t particles,
                             const std::function<Point(const SurfacePiece&)>& traction,
                             const std::vector<double>& part) {
  std::vector<Point> all(particles, Point::Zero());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (part[k] <= 0.0 || pieces[k].covered) continue;
    const Point force = part[k] * pieces[k].length() * traction(pieces[k]);
    for (const SurfacePiece::Share& s : pieces[k].shares) all[s.particle] += s.weight * force;
  }
  return all;
}

}  // namespace fpz::specimen
