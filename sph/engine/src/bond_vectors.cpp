#include "bond_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "free_surface.hpp"
#include "plane.hpp"

namespace fpz::sph::detail {

namespace {

using Vec2 = Vec<double, 2>;
using Row = Eigen::Matrix<double, multipliers, 1>;
using Block = Eigen::Matrix<double, multipliers, multipliers>;
using Directions = Eigen::Matrix<double, 2, multipliers>;
using Values = Eigen::VectorXd;

/// Lengths in units of h.
struct Bond {
  int i, j;
  Vec2 r;         ///< from i to j
  double metric;  ///< how easily the vector is changed: the least squares are those of the change over its root
  Vec2 w;
  Eigen::Matrix2d correction;  ///< mean of the ends
};

/// The vectors change with the multipliers that are imposed on i by metric * seen_from(b, 1) and with those on j by
/// metric * seen_from(b, -1); the transposed sum the vectors up: four moments and two sums of corrected vectors.
Directions seen_from(const Bond& b, double side) {
  Directions d;
  d << b.r[0], 0.0, b.r[1], 0.0, side * b.correction(0, 0), side * b.correction(0, 1),  //
      0.0, b.r[0], 0.0, b.r[1], side * b.correction(1, 0), side * b.correction(1, 1);
  return d;
}

/// The constraints of a particle: those sums over its vectors that `imposed`, a projector, lets through.
struct Particle {
  Row target = Row::Zero();
  Block imposed = Block::Identity();
  Block soft = Block::Zero();  ///< added to the diagonal: keeps what is not imposed, and what is redundant, solvable
};

class VectorProblem {
 public:
  VectorProblem(const RunData<2>& run, const NeighbourLists& lists) : run_(run) {
    make_bonds(lists);
    make_constraints();
  }

  void solve(const NeighbourLists& lists);
  [[nodiscard]] BondVectors<2> vectors(const NeighbourLists& lists) const;
  /// Normal equations of the multipliers.
  [[nodiscard]] BlockMatrix<multipliers> matrix() const;
  /// What the sums over the vectors lack.
  [[nodiscard]] Values lacking() const;

 private:
  [[nodiscard]] std::size_t count() const { return run_.particles.count; }
  void make_bonds(const NeighbourLists& lists);
  void make_constraints();
  /// Moments of the kernel's vectors, over the volumes.
  [[nodiscard]] std::vector<Symmetric> moments() const;
  /// seen_from() one of the ends, what is imposed there only.
  [[nodiscard]] Directions imposed_on(const Bond& b, int end) const {
    return seen_from(b, end == b.i ? 1.0 : -1.0) * particles_[static_cast<std::size_t>(end)].imposed;
  }

  const RunData<2>& run_;
  std::vector<Bond> bonds_;
  std::vector<Particle> particles_;
};

std::vector<Symmetric> VectorProblem::moments() const {
  std::vector<Symmetric> all(count(), {0.0, 0.0, 0.0});
  const double square = run_.h * run_.h;
  for (const Bond& b : bonds_) {
    for (const int k : {b.i, b.j}) {
      const double scale = square / run_.particles.volume[static_cast<std::size_t>(k)];
      Symmetric& m = all[static_cast<std::size_t>(k)];
      m.xx += scale * b.r[0] * b.w[0];
      m.yy += scale * b.r[1] * b.w[1];
      m.xy += scale * b.r[0] * b.w[1];
    }
  }
  return all;
}

void VectorProblem::make_bonds(const NeighbourLists& lists) {
  const Particles<2>& p = run_.particles;
  const Arrangement<2>& a = run_.setup.arrangement;
  for (std::size_t i = 0; i < count(); ++i) {
    for (const int j : lists[i]) {
      if (j < static_cast<int>(i)) continue;
      const auto k = static_cast<std::size_t>(j);
      const Vec2 from(p.start[0][i], p.start[1][i]), to(p.start[0][k], p.start[1][k]);
      const Vec2 r = (to - from) / run_.h;
      const double share = share_of_bond(a.cuts, from, to, a.spacing);
      // The same for all whole bonds: with the kernel's own weight, displacements that alternate from row to row would
      // hardly be seen by the multipliers.
      const double metric = share * run_.view.slope_norm * p.volume[i] * p.volume[k];
      const Vec2 w = metric * kernel_slope(run_.setup.options.kernel, r.norm()) * r;
      bonds_.push_back({static_cast<int>(i), j, r, metric, w, Eigen::Matrix2d::Identity()});
    }
  }
}

/// Few neighbours, or nearly all on one line.
bool is_poor(const Symmetric& moment) {
  const double mean = 0.5 * (moment.xx + moment.yy), radius = std::hypot(0.5 * (moment.xx - moment.yy), moment.xy);
  return mean - radius < 0.2 * (mean + radius);
}

void VectorProblem::make_constraints() {
  constexpr double hard = 1e-13;  // of the diagonal; more would hold back smooth multipliers
  particles_.resize(count());
  const std::vector<FreeDirections<2>> free = find_free_directions(run_);
  const std::vector<Symmetric> moment = moments();
  std::vector<Eigen::Matrix2d> correction(count(), Eigen::Matrix2d::Identity());
  for (std::size_t i = 0; i < count(); ++i) {
    Particle& p = particles_[i];
    Symmetric m = {1.0, 1.0, 0.0};
    if (free[i].count > 0 || is_poor(moment[i])) {
      m = moment[i];
      const Symmetric l = correction_of(m);
      correction[i] << l.xx, l.xy, l.xy, l.yy;
    }
    const double volume = run_.particles.volume[i] / (run_.h * run_.h);
    p.target.head<4>() << volume * m.xx, volume * m.xy, volume * m.xy, volume * m.yy;
    if (free[i].count == 1) p.imposed.bottomRightCorner<2, 2>() -= free[i].normal * free[i].normal.transpose();
    if (free[i].count == 2) p.imposed.bottomRightCorner<2, 2>().setZero();
  }
  std::vector<Row> diagonal(count(), Row::Zero());
  for (Bond& b : bonds_) {
    const auto i = static_cast<std::size_t>(b.i), j = static_cast<std::size_t>(b.j);
    b.correction = 0.5 * (correction[i] + correction[j]);
    const Row squares = b.metric * seen_from(b, 1.0).cwiseAbs2().colwise().sum().transpose();
    diagonal[i] += squares;
    diagonal[j] += squares;
  }
  for (std::size_t i = 0; i < count(); ++i) {
    const double scale = std::max(diagonal[i].mean(), 1e-12 * run_.view.slope_norm * run_.particles.volume[i]);
    particles_[i].soft = scale * ((1.0 + hard) * Block::Identity() - particles_[i].imposed);
  }
}

Values VectorProblem::lacking() const {
  Values rest(static_cast<Eigen::Index>(multipliers * count()));
  for (std::size_t i = 0; i < count(); ++i) {
    rest.segment<multipliers>(static_cast<Eigen::Index>(multipliers * i)) = particles_[i].target;
  }
  for (const Bond& b : bonds_) {
    rest.segment<multipliers>(multipliers * b.i) -= seen_from(b, 1.0).transpose() * b.w;
    rest.segment<multipliers>(multipliers * b.j) -= seen_from(b, -1.0).transpose() * b.w;
  }
  for (std::size_t i = 0; i < count(); ++i) {
    const auto at = static_cast<Eigen::Index>(multipliers * i);
    const Row all = rest.segment<multipliers>(at);
    rest.segment<multipliers>(at) = particles_[i].imposed * all;
  }
  return rest;
}

BlockMatrix<multipliers> VectorProblem::matrix() const {
  BlockMatrix<multipliers> m;
  m.row.resize(count());
  for (const Particle& p : particles_) m.diagonal.push_back(p.soft);
  for (const Bond& b : bonds_) {
    const Directions near = imposed_on(b, b.i), far = imposed_on(b, b.j);
    m.diagonal[static_cast<std::size_t>(b.i)] += b.metric * near.transpose() * near;
    m.diagonal[static_cast<std::size_t>(b.j)] += b.metric * far.transpose() * far;
    m.row[static_cast<std::size_t>(b.j)].push_back({b.i, b.metric * far.transpose() * near});
  }
  return m;
}

/// Normal equations of the multipliers: (A metric A^T + soft) multipliers = target - A w, A what is imposed. Smooth
/// multipliers hardly change the vectors, so that the equations are ill conditioned; the vectors are not, and the
/// passes after the first take the rest from the vectors themselves, until it no longer shrinks.
void VectorProblem::solve(const NeighbourLists& lists) {
  constexpr int most_passes = 30;
  constexpr double enough = 1e-14;  // of what the kernel's vectors lack
  const BlockCholesky<multipliers> factors(matrix(), dissection_order<2>(run_.particles.start, lists));
  if (!factors.ok()) {
    throw std::runtime_error(
        "the vectors of the bonds have no solution; particles may coincide (\"gradient\": "
        "\"kernel\" runs without them)");
  }
  Values rest = lacking();
  const double first = rest.norm();
  double last = HUGE_VAL;
  for (int k = 0; k < most_passes && rest.norm() > enough * first && rest.norm() < 0.5 * last; ++k) {
    last = rest.norm();
    const Values change = factors.solve(rest);
    for (Bond& b : bonds_) {
      b.w += b.metric * (imposed_on(b, b.i) * change.segment<multipliers>(multipliers * b.i) +
                         imposed_on(b, b.j) * change.segment<multipliers>(multipliers * b.j));
    }
    rest = lacking();
  }
}

BondVectors<2> VectorProblem::vectors(const NeighbourLists& lists) const {
  BondVectors<2> all{lists, {}};
  all.vector.resize(count());
  for (std::size_t i = 0; i < count(); ++i) all.vector[i].reserve(lists[i].size());
  // Bonds are sorted by i and then j: the lists fill in ascending order, the smaller neighbours first.
  for (const Bond& b : bonds_) all.vector[static_cast<std::size_t>(b.j)].push_back(-run_.h * b.w);
  for (const Bond& b : bonds_) all.vector[static_cast<std::size_t>(b.i)].push_back(run_.h * b.w);
  return all;
}

}  // namespace

template <int Dim>
const Vec<double, Dim>& BondVectors<Dim>::operator()(std::size_t i, int j) const {
  const auto place = std::lower_bound(of[i].begin(), of[i].end(), j) - of[i].begin();
  return vector[i][static_cast<std::size_t>(place)];
}

NormalEquations normal_equations(const RunData<2>& run, const NeighbourLists& lists) {
  const VectorProblem problem(run, lists);
  return {problem.matrix(), problem.lacking()};
}

template <int Dim>
BondVectors<Dim> make_bond_vectors(const RunData<Dim>& run, const NeighbourLists& lists) {
  VectorProblem problem(run, lists);
  problem.solve(lists);
  return problem.vectors(lists);
}

template struct BondVectors<2>;
template BondVectors<2> make_bond_vectors<2>(const RunData<2>&, const NeighbourLists&);

}  // namespace fpz::sph::detail
