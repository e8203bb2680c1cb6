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
  bool whole = true;  ///< its moment is to be the identity
  Row target = Row::Zero();
  Block imposed = Block::Identity();
  Block soft = Block::Zero();  ///< added to the diagonal: keeps what is not imposed, and what is redundant, solvable
};

/// Which vectors may change.
enum class Change : bool {
  anywhere,
  where_needed  ///< between particles within a few bonds of one that lacks something
};

class VectorProblem {
 public:
  VectorProblem(const RunData<2>& run, const NeighbourLists& lists, Change change);

  /// What the vectors still lack, over what the kernel's do; HUGE_VAL when the system cannot be solved.
  [[nodiscard]] double solve();
  /// Whether a tenth of the particles lack nothing: those inside a lattice.
  [[nodiscard]] bool is_partly_right() const;
  [[nodiscard]] BondVectors<2> vectors() const;
  [[nodiscard]] NormalEquations equations() const { return {matrix(), of_members(lacking()), order()}; }

 private:
  [[nodiscard]] std::size_t count() const { return run_.particles.count; }
  void make_bonds();
  void scale();
  void make_constraints();
  void make_solvable();
  /// What the sums over the vectors lack, for each particle.
  [[nodiscard]] std::vector<Row> lacking() const;
  [[nodiscard]] Mask lack() const;
  [[nodiscard]] Mask widened(Mask taken, int bonds_away) const;
  void choose_members(const Mask& taken);
  [[nodiscard]] Values of_members(const std::vector<Row>& all) const;
  /// Normal equations of the multipliers of the members.
  [[nodiscard]] BlockMatrix<multipliers> matrix() const;
  [[nodiscard]] std::vector<int> order() const;
  [[nodiscard]] int place(int particle) const { return place_[static_cast<std::size_t>(particle)]; }
  [[nodiscard]] bool may_change(const Bond& b) const { return place(b.i) >= 0 && place(b.j) >= 0; }
  /// Moments of the kernel's vectors, over the volumes.
  [[nodiscard]] std::vector<Symmetric> moments() const;
  /// seen_from() one of the ends, what is imposed there only.
  [[nodiscard]] Directions imposed_on(const Bond& b, int end) const {
    return seen_from(b, end == b.i ? 1.0 : -1.0) * particles_[static_cast<std::size_t>(end)].imposed;
  }

  const RunData<2>& run_;
  const NeighbourLists& lists_;
  std::vector<Bond> bonds_;
  std::vector<Particle> particles_;
  std::vector<std::size_t> members_;  ///< particles whose bonds with each other may change, ascending
  std::vector<int> place_;            ///< of a particle among them, or -1
};

VectorProblem::VectorProblem(const RunData<2>& run, const NeighbourLists& lists, Change change)
    : run_(run), lists_(lists) {
  constexpr int bonds_away = 3;
  make_bonds();
  make_constraints();
  if (change == Change::where_needed) scale();
  choose_members(change == Change::anywhere ? Mask(count(), 1) : widened(lack(), bonds_away));
  make_solvable();
}

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

/// Inside a lattice one factor makes the kernel's vectors right.
void VectorProblem::scale() {
  std::vector<double> mean;
  const std::vector<Symmetric> all = moments();
  for (std::size_t i = 0; i < count(); ++i) {
    if (particles_[i].whole) mean.push_back(0.5 * (all[i].xx + all[i].yy));
  }
  if (mean.empty()) return;
  const auto middle = mean.begin() + static_cast<std::ptrdiff_t>(mean.size() / 2);
  std::nth_element(mean.begin(), middle, mean.end());
  const double factor = 1.0 / *middle;
  for (Bond& b : bonds_) b.w *= factor;
}

void VectorProblem::make_bonds() {
  AlikeBonds alike(run_.setup.arrangement.spacing);
  const Particles<2>& p = run_.particles;
  const Arrangement<2>& a = run_.setup.arrangement;
  for (std::size_t i = 0; i < count(); ++i) {
    for (const int j : lists_[i]) {
      if (j < static_cast<int>(i)) continue;
      const auto k = static_cast<std::size_t>(j);
      const Vec2 from(p.start[0][i], p.start[1][i]), to(p.start[0][k], p.start[1][k]);
      const Vec2 r = alike(to - from) / run_.h;
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
  particles_.assign(count(), {});
  const std::vector<FreeDirections<2>> free = find_free_directions(run_);
  const std::vector<Symmetric> moment = moments();
  std::vector<Eigen::Matrix2d> correction(count(), Eigen::Matrix2d::Identity());
  for (std::size_t i = 0; i < count(); ++i) {
    Particle& p = particles_[i];
    Symmetric m = {1.0, 1.0, 0.0};
    p.whole = free[i].count == 0 && !is_poor(moment[i]);
    if (!p.whole) {
      m = moment[i];
      const Symmetric l = correction_of(m);
      correction[i] << l.xx, l.xy, l.xy, l.yy;
    }
    const double volume = run_.particles.volume[i] / (run_.h * run_.h);
    p.target.head<4>() << volume * m.xx, volume * m.xy, volume * m.xy, volume * m.yy;
    if (free[i].count == 1) p.imposed.bottomRightCorner<2, 2>() -= free[i].normal * free[i].normal.transpose();
    if (free[i].count == 2) p.imposed.bottomRightCorner<2, 2>().setZero();
  }
  for (Bond& b : bonds_) {
    b.correction = 0.5 * (correction[static_cast<std::size_t>(b.i)] + correction[static_cast<std::size_t>(b.j)]);
  }
}

std::vector<Row> VectorProblem::lacking() const {
  std::vector<Row> all(count());
  for (std::size_t i = 0; i < count(); ++i) all[i] = particles_[i].target;
  for (const Bond& b : bonds_) {
    all[static_cast<std::size_t>(b.i)] -= seen_from(b, 1.0).transpose() * b.w;
    all[static_cast<std::size_t>(b.j)] -= seen_from(b, -1.0).transpose() * b.w;
  }
  for (std::size_t i = 0; i < count(); ++i) all[i] = Row(particles_[i].imposed * all[i]);
  return all;
}

Mask VectorProblem::lack() const {
  constexpr double nothing = 1e-12;  // of the volume
  const std::vector<Row> rest = lacking();
  Mask lacks(count());
  for (std::size_t i = 0; i < count(); ++i) {
    lacks[i] = rest[i].cwiseAbs().maxCoeff() > nothing * run_.particles.volume[i] / (run_.h * run_.h);
  }
  return lacks;
}

bool VectorProblem::is_partly_right() const {
  const Mask lacks = lack();
  return 10 * std::count(lacks.begin(), lacks.end(), 0) >= static_cast<std::ptrdiff_t>(count());
}

Mask VectorProblem::widened(Mask taken, int bonds_away) const {
  std::vector<std::size_t> front;
  for (std::size_t i = 0; i < count(); ++i) {
    if (taken[i] != 0) front.push_back(i);
  }
  for (int k = 0; k < bonds_away; ++k) {
    std::vector<std::size_t> next;
    for (const std::size_t i : front) {
      for (const int neighbour : lists_[i]) {
        const auto j = static_cast<std::size_t>(neighbour);
        if (taken[j] == 0) next.push_back(j);
        taken[j] = 1;
      }
    }
    front = std::move(next);
  }
  return taken;
}

void VectorProblem::choose_members(const Mask& taken) {
  place_.assign(count(), -1);
  for (std::size_t i = 0; i < count(); ++i) {
    if (taken[i] == 0) continue;
    place_[i] = static_cast<int>(members_.size());
    members_.push_back(i);
  }
}

/// What is not imposed, and what is redundant, stays solvable.
void VectorProblem::make_solvable() {
  constexpr double hard = 1e-13;  // of the diagonal; more would hold back smooth multipliers
  std::vector<Row> diagonal(count(), Row::Zero());
  for (const Bond& b : bonds_) {
    if (!may_change(b)) continue;
    const Row squares = b.metric * seen_from(b, 1.0).cwiseAbs2().colwise().sum().transpose();
    diagonal[static_cast<std::size_t>(b.i)] += squares;
    diagonal[static_cast<std::size_t>(b.j)] += squares;
  }
  for (const std::size_t i : members_) {
    const double least = 1e-12 * run_.view.slope_norm * run_.particles.volume[i];
    const double size = std::max(diagonal[i].mean(), least);
    particles_[i].soft = size * ((1.0 + hard) * Block::Identity() - particles_[i].imposed);
  }
}

Values VectorProblem::of_members(const std::vector<Row>& all) const {
  Values v(static_cast<Eigen::Index>(multipliers * members_.size()));
  for (std::size_t k = 0; k < members_.size(); ++k) {
    v.segment<multipliers>(static_cast<Eigen::Index>(multipliers * k)) = all[members_[k]];
  }
  return v;
}

BlockMatrix<multipliers> VectorProblem::matrix() const {
  BlockMatrix<multipliers> m;
  m.row.resize(members_.size());
  for (const std::size_t i : members_) m.diagonal.push_back(particles_[i].soft);
  for (const Bond& b : bonds_) {
    if (!may_change(b)) continue;
    const Directions near = imposed_on(b, b.i), far = imposed_on(b, b.j);
    m.diagonal[static_cast<std::size_t>(place(b.i))] += b.metric * near.transpose() * near;
    m.diagonal[static_cast<std::size_t>(place(b.j))] += b.metric * far.transpose() * far;
    m.row[static_cast<std::size_t>(place(b.j))].push_back({place(b.i), b.metric * far.transpose() * near});
  }
  return m;
}

std::vector<int> VectorProblem::order() const {
  Fields<2> position;
  NeighbourLists neighbours(members_.size());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const std::size_t i = members_[k];
    for (std::size_t c = 0; c < position.size(); ++c) position[c].push_back(run_.particles.start[c][i]);
    for (const int j : lists_[i]) {
      if (place(j) >= 0) neighbours[k].push_back(place(j));
    }
  }
  return dissection_order<2>(position, neighbours);
}

/// Normal equations of the multipliers: (A metric A^T + soft) multipliers = target - A w, A what is imposed. Smooth
/// multipliers hardly change the vectors, so that the equations are ill conditioned; the vectors are not, and the
/// passes after the first take the rest from the vectors themselves, until it no longer shrinks.
double VectorProblem::solve() {
  constexpr int most_passes = 30;
  constexpr double enough = 1e-14;  // of what the kernel's vectors lack
  Values rest = of_members(lacking());
  const double first = rest.norm();
  if (first == 0.0) return 0.0;
  const BlockCholesky<multipliers> factors(matrix(), order());
  if (!factors.ok()) return HUGE_VAL;
  double last = HUGE_VAL;
  for (int k = 0; k < most_passes && rest.norm() > enough * first && rest.norm() < 0.5 * last; ++k) {
    last = rest.norm();
    const Values change = factors.solve(rest);
    for (Bond& b : bonds_) {
      if (!may_change(b)) continue;
      b.w += b.metric * (imposed_on(b, b.i) * change.segment<multipliers>(multipliers * place(b.i)) +
                         imposed_on(b, b.j) * change.segment<multipliers>(multipliers * place(b.j)));
    }
    rest = of_members(lacking());
  }
  return rest.norm() / first;
}

BondVectors<2> VectorProblem::vectors() const {
  BondVectors<2> all{lists_, {}};
  all.vector.resize(count());
  for (std::size_t i = 0; i < count(); ++i) all.vector[i].reserve(lists_[i].size());
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
  return VectorProblem(run, lists, Change::anywhere).equations();
}

/// On a lattice only the bonds near what lacks something change, the others keep the same bits where they are alike.
/// Vectors that may change anywhere would hardly change there (docs/method-operator.md).
template <int Dim>
BondVectors<Dim> make_bond_vectors(const RunData<Dim>& run, const NeighbourLists& lists) {
  constexpr double solved = 1e-10;
  {
    VectorProblem problem(run, lists, Change::where_needed);
    if (problem.is_partly_right() && problem.solve() < solved) return problem.vectors();
  }
  VectorProblem problem(run, lists, Change::anywhere);
  if (problem.solve() == HUGE_VAL) {
    throw std::runtime_error(
        "the vectors of the bonds have no solution; particles may coincide (\"gradient\": "
        "\"kernel\" runs without them)");
  }
  return problem.vectors();
}

template struct BondVectors<2>;
template BondVectors<2> make_bond_vectors<2>(const RunData<2>&, const NeighbourLists&);

}  // namespace fpz::sph::detail
