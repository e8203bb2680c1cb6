// The inner loops, compiled once per instruction set with FPZ_SPH_ISA naming it. One lane, one particle: every sum of a
// particle runs over its own neighbour columns in their order and never crosses lanes, so neither the width of the
// vectors nor the number of threads changes a bit of the result (contraction to fused operations is switched off).
#include "fpz/sph/kernel.hpp"
#include "fpz/sph/lanes.hpp"
#include "lane_numbers.hpp"
#include "plane.hpp"
#include "view.hpp"

#define FPZ_LANES _Pragma("omp simd") for (int l = 0; l < n; ++l)

namespace fpz::sph::detail {
namespace FPZ_SPH_ISA {
namespace {

constexpr auto n = static_cast<int>(lanes);
/// Passes take a copy of it: as stores to the arrays cannot change that, its numbers stay in registers and the compiler
/// makes vectors of the loops over lanes.
using V = View<2>;

/// Sum over lanes in their order.
FPZ_LANE double lane_sum(const double (&a)[n]) {
  double s = 0.0;
  for (int l = 0; l < n; ++l) s += a[l];
  return s;
}

/// Elastic stress of particle i, of one material for all or its own.
template <bool Several>
FPZ_LANE Symmetric elastic_stress_of(const V& v, Index i, const Symmetric& strain) {
  if constexpr (Several) return elastic_stress(v.own_lambda[i], v.own_mu[i], strain);
  return elastic_stress(v.lambda, v.mu, strain);
}

/// Whether the elastic stress is the particle's: it never cracks, or certainly not now. All others go to the library.
template <bool Several>
FPZ_LANE bool stays_elastic(const V& v, Index i, const Symmetric& s) {
  const bool safe = Several ? intact(v.own_sin_phi[i], v.own_strength[i], v.own_apex[i], s)
                            : intact(v.sin_phi, v.strength, v.apex, s);
  return (v.kind[i] == kind::elastic) | ((v.kind[i] == kind::intact) & safe);
}

/// Neighbours that follow one another.
struct InARow {
  Index first;
  FPZ_INLINED Lanes operator()(const double* a) const { return Numbers::load(a + first); }
  FPZ_INLINED Index operator[](int l) const { return first + l; }
};

/// Neighbours anywhere.
struct Scattered {
  const int* at;
  FPZ_INLINED Lanes operator()(const double* a) const { return Numbers::gather(a, at); }
  FPZ_INLINED Index operator[](int l) const { return at[l]; }
};

/// Calls f(j, m) for each column of block b: j(array) are the numbers of the lanes' neighbours, j[l] is the neighbour
/// of lane l; m the column's place in the arrays of (column, lane).
template <class F>
FPZ_LANE void over_columns(const BondView<2>& v, Index b, F&& f) {
  for (int k = v.column[b]; k < v.column[b + 1]; ++k) {
    const Index m = Index{k} * n;
    if (const int first = v.run[k]; first >= 0) {
      f(InARow{first}, m);
    } else {
      f(Scattered{v.neighbour + m}, m);
    }
  }
}

/// Calls f(j, wx, wy, beside) for each column of block b, the last three being numbers of the lanes, or one number for
/// all of them where the block has a stencil.
template <class F>
FPZ_LANE void over_bonds(const BondView<2>& v, Index b, F&& f) {
  if (const int shared = v.shared[b]; shared >= 0) {
    const int begin = v.column[b], count = v.column[b + 1] - begin;
    for (int k = 0; k < count; ++k) {
      const double beside = v.stencil_beside != nullptr ? v.stencil_beside[shared + k] : 0.0;
      f(InARow{v.run[begin + k]}, v.stencil_weight[0][shared + k], v.stencil_weight[1][shared + k], beside);
    }
  } else {
    over_columns(v, b, [&](auto j, Index m) FPZ_INLINED {
      f(j, Numbers::load(v.weight[0] + m), Numbers::load(v.weight[1] + m),
        v.beside != nullptr ? Numbers::load(v.beside + m) : Lanes{});
    });
  }
}

/// Sums over the neighbours of (u_j - u_i) times the bond's weight: the gradient of u in eq 21 before the correction of
/// eq 17, times V_i.
FPZ_LANE void difference_sums(const BondView<2>& bonds, Index b, double* const (&u)[2], double (&xx)[n],
                              double (&xy)[n], double (&yx)[n], double (&yy)[n]) {
  const double *ux = u[0], *uy = u[1];
  const Lanes own_x = Numbers::load(ux + b * n), own_y = Numbers::load(uy + b * n);
  Lanes sxx{}, sxy{}, syx{}, syy{};
  over_bonds(bonds, b, [&](auto j, auto wx, auto wy, auto) FPZ_INLINED {
    const Lanes dx = j(ux) - own_x, dy = j(uy) - own_y;
    sxx += dx * wx;
    sxy += dx * wy;
    syx += dy * wx;
    syy += dy * wy;
  });
  Numbers::store(sxx, xx);
  Numbers::store(sxy, xy);
  Numbers::store(syx, yx);
  Numbers::store(syy, yy);
}

/// Displacement gradient at n + 1 that fits the bonds of the zero-energy control best, what it leaves alone; times the
/// part of its energy that the particle has left.
FPZ_LANE void gradient_control(const V& v, Index b) {
  const Index o = b * n;
  double xx[n], xy[n], yx[n], yy[n];
  difference_sums(v.control_bonds, b, v.velocity, xx, xy, yx, yy);
  FPZ_LANES {
    const Index i = o + l;
    v.control_displacement[0][i] += v.step * v.velocity[0][i];
    v.control_displacement[1][i] += v.step * v.velocity[1][i];
    const double scale = v.step * v.control_share[i];
    const Symmetric f = {scale * v.control_fit[0][i], scale * v.control_fit[1][i], scale * v.control_fit[2][i]};
    v.control_gradient[0][i] += xx[l] * f.xx + xy[l] * f.xy;
    v.control_gradient[1][i] += xx[l] * f.xy + xy[l] * f.yy;
    v.control_gradient[2][i] += yx[l] * f.xx + yy[l] * f.xy;
    v.control_gradient[3][i] += yx[l] * f.xy + yy[l] * f.yy;
  }
}

/// F - I of the particles of a block.
struct Gradients {
  double xx[n], xy[n], yx[n], yy[n];
};

/// Stores what the gradients of block b make of its particles: rotation, strain, and stress where that is elastic.
template <bool Several>
FPZ_LANE void show(const V& v, Index b, const Gradients& g) {
  FPZ_LANES {
    const Index i = b * n + l;
    const Stretch p = polar(g.xx[l], g.xy[l], g.yx[l], g.yy[l]);
    v.rotation[0][i] = p.cosine;
    v.rotation[1][i] = p.sine;
    v.strain[0][i] = p.strain.xx;
    v.strain[1][i] = p.strain.yy;
    v.strain[2][i] = p.strain.xy;
    const Symmetric s = elastic_stress_of<Several>(v, i, p.strain);
    const bool take = stays_elastic<Several>(v, i, s);
    v.stress[0][i] = take ? s.xx : v.stress[0][i];
    v.stress[1][i] = take ? s.yy : v.stress[1][i];
    v.stress[2][i] = take ? s.xy : v.stress[2][i];
  }
}

FPZ_LANE Gradients gradients_of(const V& v, Index b) {
  Gradients g;
  FPZ_LANES {
    const Index i = b * n + l;
    g.xx[l] = v.gradient[0][i];
    g.xy[l] = v.gradient[1][i];
    g.yx[l] = v.gradient[2][i];
    g.yy[l] = v.gradient[3][i];
  }
  return g;
}

template <bool Several>
void show_reference(const V& view, Index first, Index last) {
  const V v = view;
  for (Index b = first; b < last; ++b) show<Several>(v, b, gradients_of(v, b));
}

/// For the library, which starts from the stresses at n: those that were not stored then, from the gradients that are
/// still those of n.
template <bool Several>
FPZ_LANE void show_before(const V& v, Index b) {
  double stress[3][n];
  for (int l = 0; l < n; ++l) {
    for (int c = 0; c < 3; ++c) stress[c][l] = v.stress[c][b * n + l];
  }
  show<Several>(v, b, gradients_of(v, b));
  for (int l = 0; l < n; ++l) {
    for (int c = 0; c < 3 && v.flagged[b * n + l]; ++c) v.stress[c][b * n + l] = stress[c][l];
  }
}

/// eq 31 and eq 21 in the undeformed body: positions at n + 1; velocity gradient (corrected, eq 17) -> F, its rotation
/// and stretch, elastic stress (in place of eq 24, eq 27 and eq 30) and flux of the force; flags the particles that the
/// library must update. Lean: rotation, strain and stress are stored only where the library needs them.
template <bool Several>
void strain_reference(const V& view, Index first, Index last) {
  const V v = view;
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double xx[n], xy[n], yx[n], yy[n];
    difference_sums(v.bonds, b, v.velocity, xx, xy, yx, yy);
    double raised[n];
    Gradients g;
    FPZ_LANES {
      const Index i = o + l;
      v.position[0][i] += v.step * v.velocity[0][i];
      v.position[1][i] += v.step * v.velocity[1][i];
      const Full c = {v.correction[0][i], v.correction[2][i], v.correction[3][i], v.correction[1][i]};
      const double scale = v.step / v.volume[i];
      const double bxx = v.gradient[0][i] + scale * (xx[l] * c.xx + xy[l] * c.yx);
      const double bxy = v.gradient[1][i] + scale * (xx[l] * c.xy + xy[l] * c.yy);
      const double byx = v.gradient[2][i] + scale * (yx[l] * c.xx + yy[l] * c.yx);
      const double byy = v.gradient[3][i] + scale * (yx[l] * c.xy + yy[l] * c.yy);
      g.xx[l] = bxx;
      g.xy[l] = bxy;
      g.yx[l] = byx;
      g.yy[l] = byy;
      const Stretch p = polar(bxx, bxy, byx, byy);
      const Symmetric s = elastic_stress_of<Several>(v, i, p.strain);
      const bool take = stays_elastic<Several>(v, i, s);
      const Full t = flux_of(p.cosine, p.sine, s, c);
      v.flux[0][i] = t.xx;
      v.flux[1][i] = t.xy;
      v.flux[2][i] = t.yx;
      v.flux[3][i] = t.yy;
      raised[l] = take ? 0.0 : 1.0;
    }
    const bool any = lane_sum(raised) > 0.0;
    if (v.lean && any) show_before<Several>(v, b);
    FPZ_LANES {
      v.gradient[0][o + l] = g.xx[l];
      v.gradient[1][o + l] = g.xy[l];
      v.gradient[2][o + l] = g.yx[l];
      v.gradient[3][o + l] = g.yy[l];
    }
    if (!v.lean || any) show<Several>(v, b, g);
    for (int l = 0; l < n; ++l) v.flagged[o + l] = raised[l] != 0.0;
    if (v.controlled) gradient_control(v, b);
  }
}

/// Adds the work of dissipating forces as the leap-frog does it: half of a force's work with the velocity before it,
/// half with the velocity after it, the latter counted when that motion has happened.
FPZ_LANE void account(double* total, double* next, Index b, const double (&before)[n], const double (&after)[n]) {
  total[b] += next[b] + lane_sum(before);
  next[b] = lane_sum(after);
}

/// Velocity to n + 1/2 from the force at n (eq 23 at the start, then eq 26), with gravity, forces of
/// boundaries and local damping.
FPZ_LANE void kick(const V& v, Index b, double (&fx)[n], double (&fy)[n]) {
  const Index o = b * n;
  double slow[n], before[n], after[n];
  FPZ_LANES {
    const Index i = o + l;
    const double weight = v.mass[i] * v.weight_scale;
    double gx = fx[l] + weight * v.gravity[0];
    double gy = fy[l] + weight * v.gravity[1];
    if (v.pushed) {
      gx += v.outer_force[0][i];
      gy += v.outer_force[1][i];
    }
    const double ux = v.velocity[0][i];
    const double uy = v.velocity[1][i];
    double dx = 0.0;
    double dy = 0.0;
    if (v.damped) {
      dx = -(v.damping[0][i] * v.damping_part) * __builtin_fabs(gx) * (ux > 0.0 ? 1.0 : ux < 0.0 ? -1.0 : 0.0);
      dy = -(v.damping[1][i] * v.damping_part) * __builtin_fabs(gy) * (uy > 0.0 ? 1.0 : uy < 0.0 ? -1.0 : 0.0);
    }
    const double ax = (gx + dx) * v.inverse_mass[i];
    const double ay = (gy + dy) * v.inverse_mass[i];
    const double nx = ux + v.step * ax;
    const double ny = uy + v.step * ay;
    v.acceleration[0][i] = ax;
    v.acceleration[1][i] = ay;
    v.velocity[0][i] = nx;
    v.velocity[1][i] = ny;
    before[l] = -v.work_before * (dx * ux + dy * uy);
    after[l] = -v.work_after * (dx * nx + dy * ny);
    slow[l] = nx * nx + ny * ny < v.top_speed * v.top_speed ? 1.0 : 0.0;  // false for NaN
  }
  v.bad[b] = lane_sum(slow) != n;
  if (v.damped) account(v.damping_work, v.damping_next, b, before, after);
}

/// Opposes the relative displacements that the gradients of the two ends do not explain: the derivative of
/// 1/4 sum a_i k_ij |u_j - u_i - G_i r_ij|^2 over all i and j, a_i being what is left of particle i's energy. The
/// gradients need no derivative because they minimise it.
FPZ_LANE void add_control(const V& v, Index b, Lanes& fx, Lanes& fy) {
  const Index o = b * n;
  const double *ux = v.control_displacement[0], *uy = v.control_displacement[1], *left = v.control_share;
  const double *gxx = v.control_gradient[0], *gxy = v.control_gradient[1];
  const double *gyx = v.control_gradient[2], *gyy = v.control_gradient[3];
  const Lanes own_x = Numbers::load(ux + o), own_y = Numbers::load(uy + o), own_left = Numbers::load(left + o);
  const Lanes own_xx = Numbers::load(gxx + o), own_xy = Numbers::load(gxy + o), own_yx = Numbers::load(gyx + o),
              own_yy = Numbers::load(gyy + o);
  over_bonds(v.control_bonds, b, [&](auto j, auto wx, auto wy, auto stiffness) FPZ_INLINED {
    const Lanes held = 0.5 * (own_left + j(left)) * stiffness;
    fx += held * (j(ux) - own_x) - 0.5 * ((own_xx + j(gxx)) * wx + (own_xy + j(gxy)) * wy);
    fy += held * (j(uy) - own_y) - 0.5 * ((own_yx + j(gyx)) * wx + (own_yy + j(gyy)) * wy);
  });
}

/// eq 20: internal force, sum (sigma_i L_i^T + sigma_j L_j^T) w_ij in the undeformed body, with w_ij = V_i V_j grad
/// W_ij or what takes its place; then kick().
void force_reference(const V& view, Index first, Index last) {
  const V v = view;
  const double *txx = v.flux[0], *txy = v.flux[1], *tyx = v.flux[2], *tyy = v.flux[3];
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    const Lanes own_xx = Numbers::load(txx + o), own_xy = Numbers::load(txy + o), own_yx = Numbers::load(tyx + o),
                own_yy = Numbers::load(tyy + o);
    Lanes sx{}, sy{};
    over_bonds(v.bonds, b, [&](auto j, auto wx, auto wy, auto) FPZ_INLINED {
      sx += (own_xx + j(txx)) * wx + (own_xy + j(txy)) * wy;
      sy += (own_yx + j(tyx)) * wx + (own_yy + j(tyy)) * wy;
    });
    if (v.controlled) add_control(v, b, sx, sy);
    double fx[n], fy[n];
    Numbers::store(sx, fx);
    Numbers::store(sy, fy);
    kick(v, b, fx, fy);
  }
}

/// Positions at n + 1 (eq 31) and the velocities there (eq 29: extrapolated, for the viscosity only).
void drift_updated(const V& v, Index first, Index last) {
  for (int c = 0; c < 2; ++c) {
    double* __restrict x = v.position[c];
    double* __restrict p = v.predicted[c];
    const double* u = v.velocity[c];
    const double* a = v.acceleration[c];
    for (Index i = first * n; i < last * n; ++i) {
      x[i] += v.step * u[i];
      p[i] = u[i] + 0.5 * v.step * a[i];
    }
  }
}

/// Kernel gradients of the present positions, L_i of eq 18, velocity gradient of eq 21 -> density (eq 19) and rotated
/// stress (eq 21) from n to n + 1, exact for a linear motion: in place of eq 22, eq 25 and eq 28 for the density and of
/// eq 24, eq 27 and eq 30 for the stress. Flux of the force; flags what the library must update.
template <Kernel K, bool PaperMomentum, bool Several>
void strain_updated(const V& view, Index first, Index last) {
  const V v = view;
  const double *x = v.position[0], *y = v.position[1], *ux = v.velocity[0], *uy = v.velocity[1];
  const double* volume = v.volume;
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double mxx[n] = {}, myy[n] = {}, mxy[n] = {};           // moment matrix of eq 18, times V_i
    double xx[n] = {}, xy[n] = {}, yx[n] = {}, yy[n] = {};  // velocity gradient before correction, times V_i
    over_columns(v.bonds, b, [&](auto neighbour, Index m) FPZ_INLINED {
      double* wx = v.bonds.weight[0] + m;
      double* wy = v.bonds.weight[1] + m;
      double* closeness = v.bonds.beside + m;
      FPZ_LANES {
        const Index j = neighbour[l];
        const double rx = x[j] - x[o + l];
        const double ry = y[j] - y[o + l];
        const double q = __builtin_sqrt(rx * rx + ry * ry) * v.inverse_smoothing;
        const double slope = v.slope_norm * (volume[o + l] * volume[j]) * kernel_slope<K>(q);
        const double gx = slope * rx;
        const double gy = slope * ry;
        wx[l] = gx;
        wy[l] = gy;
        // Not above one: particles closer than a spacing would repel more the more they are pulled.
        const double shape = kernel_shape<K>(q) * v.reference_shape;
        const double near = shape < 1.0 ? shape : 1.0;
        closeness[l] = (near * near) * (near * near);
        const double dx = ux[j] - ux[o + l];
        const double dy = uy[j] - uy[o + l];
        mxx[l] += rx * gx;
        myy[l] += ry * gy;
        mxy[l] += rx * gy;
        xx[l] += dx * gx;
        xy[l] += dx * gy;
        yx[l] += dy * gx;
        yy[l] += dy * gy;
      }
    });
    double raised[n];
    FPZ_LANES {
      const Index i = o + l;
      const double inverse = 1.0 / volume[i];
      const Symmetric c = correction_of(Symmetric{mxx[l] * inverse, myy[l] * inverse, mxy[l] * inverse});
      v.correction[0][i] = c.xx;
      v.correction[1][i] = c.yy;
      v.correction[2][i] = c.xy;
      v.correction[3][i] = c.xy;
      // a = step * velocity gradient in the configuration of the end: F of the step is (I - a)^-1 = I + f.
      const double scale = v.step * inverse;
      const double axx = scale * (xx[l] * c.xx + xy[l] * c.xy);
      const double axy = scale * (xx[l] * c.xy + xy[l] * c.yy);
      const double ayx = scale * (yx[l] * c.xx + yy[l] * c.xy);
      const double ayy = scale * (yx[l] * c.xy + yy[l] * c.yy);
      const double det = axx * ayy - axy * ayx;
      const double shrink = 1.0 - (axx + ayy) + det;  // volume before over volume after
      const double grow = 1.0 / shrink;
      const Stretch p = polar((axx - det) * grow, axy * grow, ayx * grow, (ayy - det) * grow);
      v.density[i] *= shrink;
      v.rotation[0][i] = p.cosine;
      v.rotation[1][i] = p.sine;
      v.strain[0][i] = p.strain.xx;
      v.strain[1][i] = p.strain.yy;
      v.strain[2][i] = p.strain.xy;
      const Symmetric d = elastic_stress_of<Several>(v, i, p.strain);
      const Symmetric old = {v.stress[0][i], v.stress[1][i], v.stress[2][i]};
      const Symmetric s = rotated(p.cosine, p.sine, {old.xx + d.xx, old.yy + d.yy, old.xy + d.xy});
      const bool take = stays_elastic<Several>(v, i, s);
      v.stress[0][i] = take ? s.xx : old.xx;
      v.stress[1][i] = take ? s.yy : old.yy;
      v.stress[2][i] = take ? s.xy : old.xy;
      const Symmetric identity = {1.0, 1.0, 0.0};
      const Full t = flux_of(1.0, 0.0, s, full(PaperMomentum ? identity : c));
      v.flux[0][i] = t.xx;
      v.flux[1][i] = t.xy;
      v.flux[2][i] = t.yx;
      v.flux[3][i] = t.yy;
      const Symmetric r = tensile_repulsion(v.artificial_stress, s);
      v.artificial[0][i] = r.xx;
      v.artificial[1][i] = r.yy;
      v.artificial[2][i] = r.xy;
      raised[l] = take ? 0.0 : 1.0;
    }
    for (int l = 0; l < n; ++l) v.flagged[o + l] = raised[l] != 0.0;
  }
}

/// eq 20 with artificial viscosity and stress (C_ij); then kick(). The paper's form has L_i on both stresses.
template <Kernel K, bool PaperMomentum>
void force_updated(const V& view, Index first, Index last) {
  const V v = view;
  const double *txx = v.flux[0], *txy = v.flux[1], *tyx = v.flux[2], *tyy = v.flux[3];
  const double *x = v.position[0], *y = v.position[1], *ux = v.predicted[0], *uy = v.predicted[1];
  const double *rxx = v.artificial[0], *ryy = v.artificial[1], *rxy = v.artificial[2];
  const double h = v.smoothing;
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double fx[n] = {}, fy[n] = {}, vx[n] = {}, vy[n] = {}, ax[n] = {}, ay[n] = {};
    over_columns(v.bonds, b, [&](auto neighbour, Index m) FPZ_INLINED {
      const double* wx = v.bonds.weight[0] + m;
      const double* wy = v.bonds.weight[1] + m;
      const double* closeness = v.bonds.beside + m;
      FPZ_LANES {
        const Index i = o + l, j = neighbour[l];
        double gx = wx[l];
        double gy = wy[l];
        if constexpr (PaperMomentum) {
          gx = v.correction[0][i] * wx[l] + v.correction[2][i] * wy[l];
          gy = v.correction[2][i] * wx[l] + v.correction[1][i] * wy[l];
        }
        fx[l] += (txx[i] + txx[j]) * gx + (txy[i] + txy[j]) * gy;
        fy[l] += (tyx[i] + tyx[j]) * gx + (tyy[i] + tyy[j]) * gy;
        // Artificial viscosity, only while the pair approaches; rocks keep their density, its mean of the pair would
        // cost a gather and a division.
        const double dx = x[j] - x[i];
        const double dy = y[j] - y[i];
        const double approach = (ux[j] - ux[i]) * dx + (uy[j] - uy[i]) * dy;
        const double rate = h * (approach < 0.0 ? approach : 0.0) / (dx * dx + dy * dy + 0.01 * h * h);
        const double pressure = v.rest_density * rate * (v.viscosity_beta * rate - v.viscosity_alpha * v.sound_speed);
        vx[l] -= pressure * gx;
        vy[l] -= pressure * gy;
        const double f = closeness[l];
        ax[l] += f * ((rxx[i] + rxx[j]) * gx + (rxy[i] + rxy[j]) * gy);
        ay[l] += f * ((rxy[i] + rxy[j]) * gx + (ryy[i] + ryy[j]) * gy);
      }
    });
    // Half of a force's work is done with the velocity before it, half with the one after it: that of the last step's
    // forces is counted now, with what the groups have made of the velocity.
    double sum_x[n], sum_y[n], viscous[n], artificial[n];
    FPZ_LANES {
      const Index i = o + l;
      const double mx = -v.work_before * v.velocity[0][i];
      const double my = -v.work_before * v.velocity[1][i];
      viscous[l] = (vx[l] + v.viscous_force[0][i]) * mx + (vy[l] + v.viscous_force[1][i]) * my;
      artificial[l] = (ax[l] + v.artificial_force[0][i]) * mx + (ay[l] + v.artificial_force[1][i]) * my;
      v.viscous_force[0][i] = vx[l];
      v.viscous_force[1][i] = vy[l];
      v.artificial_force[0][i] = ax[l];
      v.artificial_force[1][i] = ay[l];
      sum_x[l] = fx[l] + vx[l] + ax[l];
      sum_y[l] = fy[l] + vy[l] + ay[l];
    }
    v.viscous_work[b] += lane_sum(viscous);
    v.artificial_work[b] += lane_sum(artificial);
    kick(v, b, sum_x, sum_y);
  }
}

template <Kernel K, bool PaperMomentum, bool Several>
constexpr Passes<2> passes = {strain_reference<Several>,
                              show_reference<Several>,
                              force_reference,
                              drift_updated,
                              strain_updated<K, PaperMomentum, Several>,
                              force_updated<K, PaperMomentum>};

template <bool Several>
const Passes<2>& choose(int kernel, int momentum) {
  static constexpr const Passes<2>* table[2][2] = {
      {&passes<Kernel::cubic_spline, false, Several>, &passes<Kernel::cubic_spline, true, Several>},
      {&passes<Kernel::wendland_c2, false, Several>, &passes<Kernel::wendland_c2, true, Several>}};
  return *table[kernel][momentum];
}
const Passes<2>& choose(int kernel, int momentum, bool several) {
  return several ? choose<true>(kernel, momentum) : choose<false>(kernel, momentum);
}

}  // namespace
}  // namespace FPZ_SPH_ISA
}  // namespace fpz::sph::detail
