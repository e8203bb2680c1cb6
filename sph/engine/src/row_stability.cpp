#include "row_stability.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <random>

#include "sort_unique.hpp"

namespace fpz::sph::detail {

namespace {
/// Frequency times half the time step that is borne: that of the intact body is 0.9 at most (stability_margin).
constexpr double most = 0.95;
/// A softening goes a little further than it must, so that few of them suffice; and rows with this part of the largest
/// energy take part in it.
constexpr double further = 0.95;
constexpr double takes_part = 0.3;
constexpr int most_rounds = 20;
/// Steps of the Lanczos method: the largest eigenvalue to a percent.
constexpr int lanczos_steps = 16;
}  // namespace

/// Particles that may move, those whose strain they change, and the entries of the latters' rows.
template <int Dim>
struct RowStability<Dim>::Patch {
  std::vector<std::size_t> rows;  ///< particles with their gradient in the patch
  std::vector<int> place;         ///< of a row's particle among those that move, -1: held
  struct Entry {
    int row;      ///< place among `rows`
    int other;    ///< place of the other end among those that move, -1: held
    double x, y;  ///< the bond's vector
  };
  std::vector<Entry> entries;
  std::vector<double> root_mass;  ///< of those that move
};

template <int Dim>
typename RowStability<Dim>::Patch RowStability<Dim>::patch_around(const std::vector<std::size_t>& changed) const {
  std::vector<std::size_t> moving = changed;
  for (const std::size_t i : changed) {
    for (const int j : rows_.neighbours(i)) moving.push_back(static_cast<std::size_t>(j));
  }
  sort_unique(moving);
  Patch patch;
  patch.rows = moving;
  for (const std::size_t i : moving) {
    patch.root_mass.push_back(std::sqrt(run_.particles.mass[i]));
    for (const int j : rows_.neighbours(i)) patch.rows.push_back(static_cast<std::size_t>(j));
  }
  sort_unique(patch.rows);
  const auto place_in = [](const std::vector<std::size_t>& a, std::size_t i) {
    const auto at = std::lower_bound(a.begin(), a.end(), i);
    return at != a.end() && *at == i ? static_cast<int>(at - a.begin()) : -1;
  };
  for (std::size_t r = 0; r < patch.rows.size(); ++r) {
    const std::size_t i = patch.rows[r];
    patch.place.push_back(place_in(moving, i));
    rows_.for_bonds(i, [&](std::size_t j, double x, double y) {
      patch.entries.push_back({static_cast<int>(r), place_in(moving, j), x, y});
    });
  }
  return patch;
}

template <int Dim>
typename RowStability<Dim>::Mode RowStability<Dim>::fastest(const Patch& patch) const {
  using Eigen::MatrixXd;
  using Eigen::VectorXd;
  const Particles<Dim>& p = run_.particles;
  const auto n = static_cast<Eigen::Index>(2 * patch.root_mass.size());
  const std::size_t count = patch.rows.size();
  std::vector<Full> flux(count);
  std::vector<double> energies(count);
  // M^-1/2 K M^-1/2 of a vector; the energies of its rows besides.
  const auto stiffness = [&](const VectorXd& v) {
    std::vector<Full> g(count, Full{0.0, 0.0, 0.0, 0.0});
    const auto part = [&](int place, int c) {
      return place < 0 ? 0.0 : v[2 * place + c] / patch.root_mass[static_cast<std::size_t>(place)];
    };
    for (const auto& e : patch.entries) {
      const int own = patch.place[static_cast<std::size_t>(e.row)];
      const double ux = part(e.other, 0) - part(own, 0), uy = part(e.other, 1) - part(own, 1);
      Full& a = g[static_cast<std::size_t>(e.row)];
      a = {a.xx + ux * e.x, a.xy + ux * e.y, a.yx + uy * e.x, a.yy + uy * e.y};
    }
    for (std::size_t r = 0; r < count; ++r) {
      const std::size_t i = patch.rows[r];
      const Full l = {p.correction[0][i], p.correction[2][i], p.correction[3][i], p.correction[1][i]};
      const Full a = product(g[r], l);
      const double inverse = 1.0 / p.volume[i];
      const Symmetric strain = {inverse * a.xx, inverse * a.yy, 0.5 * inverse * (a.xy + a.yx)};
      const auto& bulk = run_.materials.bulk(i);
      const Symmetric s = elastic_stress(bulk.lambda, bulk.mu, strain);
      energies[r] = p.volume[i] * (s.xx * strain.xx + s.yy * strain.yy + 2.0 * s.xy * strain.xy);
      flux[r] = flux_of(1.0, 0.0, s, l);
    }
    VectorXd f = VectorXd::Zero(n);
    for (const auto& e : patch.entries) {
      const Full& t = flux[static_cast<std::size_t>(e.row)];
      const double fx = t.xx * e.x + t.xy * e.y, fy = t.yx * e.x + t.yy * e.y;
      const auto add = [&](int place, double sign) {
        if (place < 0) return;
        const double root = sign / patch.root_mass[static_cast<std::size_t>(place)];
        f[2 * place] += root * fx;
        f[2 * place + 1] += root * fy;
      };
      add(e.other, 1.0);
      add(patch.place[static_cast<std::size_t>(e.row)], -1.0);
    }
    return f;
  };
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto steps = std::min<Eigen::Index>(lanczos_steps, n);
  MatrixXd basis(n, steps);
  VectorXd diagonal(steps), beside = VectorXd::Zero(std::max<Eigen::Index>(steps - 1, 1));
  VectorXd v(n);
  for (double& x : v) x = uniform(rng);
  v.normalize();
  Eigen::Index done = 0;
  for (Eigen::Index k = 0; k < steps; ++k) {
    basis.col(k) = v;
    VectorXd w = stiffness(v);
    diagonal[k] = v.dot(w);
    done = k + 1;
    // Against all before it: the cheap two are not enough in rounding.
    for (int twice = 0; twice < 2; ++twice) w -= basis.leftCols(done) * (basis.leftCols(done).transpose() * w);
    const double size = w.norm();
    if (k + 1 == steps || !(size > 1e-12 * std::abs(diagonal[0]))) break;
    beside[k] = size;
    v = w / size;
  }
  Eigen::SelfAdjointEigenSolver<MatrixXd> small;
  small.computeFromTridiagonal(diagonal.head(done), beside.head(done - 1));
  Mode mode;
  mode.square = small.eigenvalues()[done - 1];
  stiffness(basis.leftCols(done) * small.eigenvectors().col(done - 1));
  mode.energies = energies;
  return mode;
}

template <int Dim>
void RowStability<Dim>::keep(const std::vector<std::size_t>& changed) {
  if (changed.empty() || run_.setup.options.momentum != MomentumForm::adjoint) return;
  const double half_step = 0.5 * run_.dt;
  const double borne = most * most / (half_step * half_step * (1.0 + run_.view.damping_part));
  const Patch patch = patch_around(changed);
  for (int round = 0; round < most_rounds; ++round) {
    const Mode mode = fastest(patch);
    if (!(mode.square > borne)) return;
    const double part = further * std::sqrt(borne / mode.square);
    const double largest = *std::max_element(mode.energies.begin(), mode.energies.end());
    for (std::size_t r = 0; r < patch.rows.size(); ++r) {
      if (mode.energies[r] >= takes_part * largest) rows_.soften(patch.rows[r], part);
    }
  }
}

template class RowStability<2>;

}  // namespace fpz::sph::detail
