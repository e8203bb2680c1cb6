// The inner loops, compiled once per instruction set with FPZ_SPH_ISA naming it. One lane, one particle: every sum of a
// particle runs over its own neighbour columns in their order and never crosses lanes, so neither the width of the
// vectors nor the number of threads changes a bit of the result (contraction to fused operations is switched off).
#include "fpz/sph/kernel.hpp"
#include "fpz/sph/lanes.hpp"
#include "plane.hpp"
#include "view.hpp"

#define FPZ_LANES _Pragma("omp simd") for (int l = 0; l < n; ++l)

namespace fpz::sph::detail {
namespace FPZ_SPH_ISA {
namespace {

constexpr auto n = static_cast<int>(lanes);
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

/// Positions at n + 1 (eq 31) and the velocities there (eq 29: extrapolated, for the viscosity only).
void drift(const V& v, Index first, Index last) {
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

/// Sums over the neighbours of (u_j - u_i) times the bond's weight: the gradient of u in eq 21 before the correction of
/// eq 17, times V_i.
FPZ_LANE void difference_sums(const V& v, Index b, const double* ux, const double* uy, double (&xx)[n], double (&xy)[n],
                              double (&yx)[n], double (&yy)[n]) {
  const Index o = b * n;
  for (int k = v.column[b]; k < v.column[b + 1]; ++k) {
    const Index m = Index{k} * n;
    const int* j = v.neighbour + m;
    const double* wx = v.weight[0] + m;
    const double* wy = v.weight[1] + m;
    FPZ_LANES {
      const double dx = ux[j[l]] - ux[o + l];
      const double dy = uy[j[l]] - uy[o + l];
      xx[l] += dx * wx[l];
      xy[l] += dx * wy[l];
      yx[l] += dy * wx[l];
      yy[l] += dy * wy[l];
    }
  }
}

/// eq 21 in the undeformed body: velocity gradient (corrected, eq 17) -> F, its rotation and stretch, elastic stress
/// (in place of eq 24, eq 27 and eq 30) and flux of the force; flags the particles that the library must update.
template <bool Several>
void gradient_reference(const V& v, Index first, Index last) {
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double xx[n] = {}, xy[n] = {}, yx[n] = {}, yy[n] = {};
    difference_sums(v, b, v.velocity[0], v.velocity[1], xx, xy, yx, yy);
    double raised[n];
    FPZ_LANES {
      const Index i = o + l;
      const Full c = {v.correction[0][i], v.correction[2][i], v.correction[3][i], v.correction[1][i]};
      const double scale = v.step / v.volume[i];
      const double bxx = v.gradient[0][i] + scale * (xx[l] * c.xx + xy[l] * c.yx);
      const double bxy = v.gradient[1][i] + scale * (xx[l] * c.xy + xy[l] * c.yy);
      const double byx = v.gradient[2][i] + scale * (yx[l] * c.xx + yy[l] * c.yx);
      const double byy = v.gradient[3][i] + scale * (yx[l] * c.xy + yy[l] * c.yy);
      v.gradient[0][i] = bxx;
      v.gradient[1][i] = bxy;
      v.gradient[2][i] = byx;
      v.gradient[3][i] = byy;
      const Stretch p = polar(bxx, bxy, byx, byy);
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
      const Full t = flux_of(p.cosine, p.sine, s, c);
      v.flux[0][i] = t.xx;
      v.flux[1][i] = t.xy;
      v.flux[2][i] = t.yx;
      v.flux[3][i] = t.yy;
      raised[l] = take ? 0.0 : 1.0;
    }
    for (int l = 0; l < n; ++l) v.flagged[o + l] = raised[l] != 0.0;
  }
}

/// Adds the work of dissipating forces as the leap-frog does it: half of a force's work with the velocity before it,
/// half with the velocity after it, the latter counted when that motion has happened.
FPZ_LANE void account(double* total, double* next, Index b, const double (&before)[n], const double (&after)[n]) {
  total[b] += next[b] + lane_sum(before);
  next[b] = lane_sum(after);
}

/// Velocity to n + 1/2 from the force at n (eq 23 at the start, then eq 26), with gravity, zero-energy control, forces
/// of boundaries and local damping.
FPZ_LANE void kick(const V& v, Index b, double (&fx)[n], double (&fy)[n]) {
  const Index o = b * n;
  double slow[n], before[n], after[n];
  FPZ_LANES {
    const Index i = o + l;
    const double weight = v.mass[i] * v.weight_scale;
    double gx = fx[l] + weight * v.gravity[0];
    double gy = fy[l] + weight * v.gravity[1];
    if (v.controlled) {
      gx += v.zero_energy_force[0][i];
      gy += v.zero_energy_force[1][i];
    }
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

/// eq 20: internal force, sum (sigma_i L_i^T + sigma_j L_j^T) w_ij in the undeformed body, with w_ij = V_i V_j grad
/// W_ij or what takes its place; then kick().
void force_reference(const V& v, Index first, Index last) {
  const double *txx = v.flux[0], *txy = v.flux[1], *tyx = v.flux[2], *tyy = v.flux[3];
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double fx[n] = {}, fy[n] = {};
    for (int k = v.column[b]; k < v.column[b + 1]; ++k) {
      const Index m = Index{k} * n;
      const int* j = v.neighbour + m;
      const double* wx = v.weight[0] + m;
      const double* wy = v.weight[1] + m;
      FPZ_LANES {
        fx[l] += (txx[o + l] + txx[j[l]]) * wx[l] + (txy[o + l] + txy[j[l]]) * wy[l];
        fy[l] += (tyx[o + l] + tyx[j[l]]) * wx[l] + (tyy[o + l] + tyy[j[l]]) * wy[l];
      }
    }
    kick(v, b, fx, fy);
  }
}

/// Displacement gradient that fits the bonds of the zero-energy control best, what it leaves alone; times the part of
/// its energy that the particle has left.
void gradient_zero_energy(const V& v, Index first, Index last) {
  const double *x = v.zero_energy_displacement[0], *y = v.zero_energy_displacement[1];
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double xx[n] = {}, xy[n] = {}, yx[n] = {}, yy[n] = {};
    for (int k = v.zero_energy_column[b]; k < v.zero_energy_column[b + 1]; ++k) {
      const Index m = Index{k} * n;
      const int* j = v.zero_energy_neighbour + m;
      const double* wx = v.zero_energy_weight[0] + m;
      const double* wy = v.zero_energy_weight[1] + m;
      FPZ_LANES {
        const double ux = x[j[l]] - x[o + l];
        const double uy = y[j[l]] - y[o + l];
        xx[l] += ux * wx[l];
        xy[l] += ux * wy[l];
        yx[l] += uy * wx[l];
        yy[l] += uy * wy[l];
      }
    }
    FPZ_LANES {
      const Index i = o + l;
      const double left = v.zero_energy_share[i];
      const Symmetric f = {left * v.zero_energy_fit[0][i], left * v.zero_energy_fit[1][i],
                           left * v.zero_energy_fit[2][i]};
      v.zero_energy_gradient[0][i] = xx[l] * f.xx + xy[l] * f.xy;
      v.zero_energy_gradient[1][i] = xx[l] * f.xy + xy[l] * f.yy;
      v.zero_energy_gradient[2][i] = yx[l] * f.xx + yy[l] * f.xy;
      v.zero_energy_gradient[3][i] = yx[l] * f.xy + yy[l] * f.yy;
    }
  }
}

/// Opposes the relative displacements that the gradients of the two ends do not explain: the derivative of
/// 1/4 sum a_i k_ij |u_j - u_i - G_i r_ij|^2 over all i and j, a_i being what is left of particle i's energy. The
/// gradients need no derivative because they minimise it.
void force_zero_energy(const V& v, Index first, Index last) {
  const double *x = v.zero_energy_displacement[0], *y = v.zero_energy_displacement[1];
  const double *gxx = v.zero_energy_gradient[0], *gxy = v.zero_energy_gradient[1];
  const double *gyx = v.zero_energy_gradient[2], *gyy = v.zero_energy_gradient[3];
  const double* left = v.zero_energy_share;
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double fx[n] = {}, fy[n] = {};
    for (int k = v.zero_energy_column[b]; k < v.zero_energy_column[b + 1]; ++k) {
      const Index m = Index{k} * n;
      const int* j = v.zero_energy_neighbour + m;
      const double* stiffness = v.zero_energy_stiffness + m;
      const double* wx = v.zero_energy_weight[0] + m;
      const double* wy = v.zero_energy_weight[1] + m;
      FPZ_LANES {
        const Index i = o + l;
        const double ux = x[j[l]] - x[i];
        const double uy = y[j[l]] - y[i];
        const double held = 0.5 * (left[i] + left[j[l]]) * stiffness[l];
        fx[l] += held * ux - 0.5 * ((gxx[i] + gxx[j[l]]) * wx[l] + (gxy[i] + gxy[j[l]]) * wy[l]);
        fy[l] += held * uy - 0.5 * ((gyx[i] + gyx[j[l]]) * wx[l] + (gyy[i] + gyy[j[l]]) * wy[l]);
      }
    }
    FPZ_LANES {
      v.zero_energy_force[0][o + l] = fx[l];
      v.zero_energy_force[1][o + l] = fy[l];
    }
  }
}

/// Kernel gradients of the present positions, L_i of eq 18, velocity gradient of eq 21 -> density (eq 19) and rotated
/// stress (eq 21) from n to n + 1, exact for a linear motion: in place of eq 22, eq 25 and eq 28 for the density and of
/// eq 24, eq 27 and eq 30 for the stress. Flux of the force; flags what the library must update.
template <Kernel K, bool PaperMomentum, bool Several>
void gradient_updated(const V& v, Index first, Index last) {
  const double *x = v.position[0], *y = v.position[1], *ux = v.velocity[0], *uy = v.velocity[1];
  const double* volume = v.volume;
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double mxx[n] = {}, myy[n] = {}, mxy[n] = {};           // moment matrix of eq 18, times V_i
    double xx[n] = {}, xy[n] = {}, yx[n] = {}, yy[n] = {};  // velocity gradient before correction, times V_i
    for (int k = v.column[b]; k < v.column[b + 1]; ++k) {
      const Index m = Index{k} * n;
      const int* j = v.neighbour + m;
      double* wx = v.weight[0] + m;
      double* wy = v.weight[1] + m;
      double* closeness = v.closeness + m;
      FPZ_LANES {
        const double rx = x[j[l]] - x[o + l];
        const double ry = y[j[l]] - y[o + l];
        const double q = __builtin_sqrt(rx * rx + ry * ry) * v.inverse_smoothing;
        const double slope = v.slope_norm * (volume[o + l] * volume[j[l]]) * kernel_slope<K>(q);
        const double gx = slope * rx;
        const double gy = slope * ry;
        wx[l] = gx;
        wy[l] = gy;
        // Not above one: particles closer than a spacing would repel more the more they are pulled.
        const double shape = kernel_shape<K>(q) * v.reference_shape;
        const double near = shape < 1.0 ? shape : 1.0;
        closeness[l] = (near * near) * (near * near);
        const double dx = ux[j[l]] - ux[o + l];
        const double dy = uy[j[l]] - uy[o + l];
        mxx[l] += rx * gx;
        myy[l] += ry * gy;
        mxy[l] += rx * gy;
        xx[l] += dx * gx;
        xy[l] += dx * gy;
        yx[l] += dy * gx;
        yy[l] += dy * gy;
      }
    }
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
void force_updated(const V& v, Index first, Index last) {
  const double *txx = v.flux[0], *txy = v.flux[1], *tyx = v.flux[2], *tyy = v.flux[3];
  const double *x = v.position[0], *y = v.position[1], *ux = v.predicted[0], *uy = v.predicted[1];
  const double *rxx = v.artificial[0], *ryy = v.artificial[1], *rxy = v.artificial[2];
  const double h = v.smoothing;
  for (Index b = first; b < last; ++b) {
    const Index o = b * n;
    double fx[n] = {}, fy[n] = {}, vx[n] = {}, vy[n] = {}, ax[n] = {}, ay[n] = {};
    for (int k = v.column[b]; k < v.column[b + 1]; ++k) {
      const Index m = Index{k} * n;
      const int* j = v.neighbour + m;
      const double* wx = v.weight[0] + m;
      const double* wy = v.weight[1] + m;
      const double* closeness = v.closeness + m;
      FPZ_LANES {
        const Index i = o + l;
        double gx = wx[l];
        double gy = wy[l];
        if constexpr (PaperMomentum) {
          gx = v.correction[0][i] * wx[l] + v.correction[2][i] * wy[l];
          gy = v.correction[2][i] * wx[l] + v.correction[1][i] * wy[l];
        }
        fx[l] += (txx[i] + txx[j[l]]) * gx + (txy[i] + txy[j[l]]) * gy;
        fy[l] += (tyx[i] + tyx[j[l]]) * gx + (tyy[i] + tyy[j[l]]) * gy;
        // Artificial viscosity, only while the pair approaches; rocks keep their density, its mean of the pair would
        // cost a gather and a division.
        const double dx = x[j[l]] - x[i];
        const double dy = y[j[l]] - y[i];
        const double approach = (ux[j[l]] - ux[i]) * dx + (uy[j[l]] - uy[i]) * dy;
        const double rate = h * (approach < 0.0 ? approach : 0.0) / (dx * dx + dy * dy + 0.01 * h * h);
        const double pressure = v.rest_density * rate * (v.viscosity_beta * rate - v.viscosity_alpha * v.sound_speed);
        vx[l] -= pressure * gx;
        vy[l] -= pressure * gy;
        const double f = closeness[l];
        ax[l] += f * ((rxx[i] + rxx[j[l]]) * gx + (rxy[i] + rxy[j[l]]) * gy);
        ay[l] += f * ((rxy[i] + rxy[j[l]]) * gx + (ryy[i] + ryy[j[l]]) * gy);
      }
    }
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
constexpr Passes<2> passes = {drift,
                              gradient_reference<Several>,
                              force_reference,
                              gradient_zero_energy,
                              force_zero_energy,
                              gradient_updated<K, PaperMomentum, Several>,
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
